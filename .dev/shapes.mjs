// npm run shapes -- …: the generator of the shape collection, built first if need be. Without
// arguments it says what it can do.
import { spawn } from "node:child_process";
import path from "node:path";
import { buildPreset } from "./build.mjs";
import { drawContactSheet } from "./contact_sheet.mjs";
import { beQuiet, main, root } from "./run.mjs";
import { ensureSystemPackages } from "./system.mjs";

await main(async () => {
    beQuiet();
    await ensureSystemPackages("native");
    await buildPreset("release", { targets: ["generate_shapes"] });
    const generator = path.join(root, "build/release/core/shapes/generate_shapes");
    const words = process.argv.slice(2);
    // npm changes to the project's root; paths are meant from where the user called it.
    const cwd = process.env.INIT_CWD ?? process.cwd();
    if (words.some((word) => word.startsWith("--contact-sheet"))) {
        await drawContactSheet(generator, words, cwd);
        return 0;
    }
    return new Promise((resolve) => {
        const child = spawn(generator, words, { cwd, stdio: "inherit" });
        child.on("close", (code) => resolve(code ?? 1));
    });
});
