// npm run docs: the table of errors, wasm/ERRORS.md, from what the package says, and its API reference
// from the comments, in build/docs. What is exported without a comment, or a link that leads nowhere,
// is an error.
import { writeFileSync } from "node:fs";
import path from "node:path";
import { buildPackage, installPackages } from "./build.mjs";
import { main, root, run, say } from "./run.mjs";

await main(async () => {
    await installPackages();
    await buildPackage();
    const { errorTable } = await import("./error_table.mjs");
    writeFileSync(path.join(root, "wasm/ERRORS.md"), await errorTable());
    await run(process.execPath, ["node_modules/typedoc/bin/typedoc", "--logLevel", "Warn"]);
    say("wasm/ERRORS.md and build/docs/index.html are written");
});
