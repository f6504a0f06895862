// npm run lint: formatting and static checks of everything; --fix (npm run format) mends what can be
// mended; --tidy adds clang-tidy, which takes minutes.
import { existsSync } from "node:fs";
import { parseArgs } from "node:util";
import { buildPackage, buildPreset, installPackages } from "./build.mjs";
import { filesBelow, main, output, root, run, say } from "./run.mjs";
import { ensureSystemPackages } from "./system.mjs";

await main(async () => {
    const { values } = parseArgs({
        options: { fix: { type: "boolean" }, tidy: { type: "boolean" } },
    });
    await ensureSystemPackages("lint", ...(values.tidy ? ["native", "tidy"] : []));
    await installPackages();
    // The page and the tests see the package through its built types.
    await buildPackage();

    const cpp = ["core", "wasm", "tests"].flatMap(filesBelow).filter((f) => /\.(hh|cc)$/.test(f));
    const tool = (name) => `node_modules/${name}`;
    const node = (...args) => [process.execPath, args];
    const checks = values.fix
        ? [
              ["clang-format", ["-i", ...cpp]],
              node(tool("prettier/bin/prettier.cjs"), "--write", "--log-level=warn", "."),
              node(tool("eslint/bin/eslint.js"), "--fix", "."),
          ]
        : [
              ["clang-format", ["--dry-run", "-Werror", ...cpp]],
              node(tool("prettier/bin/prettier.cjs"), "--check", "--log-level=warn", "."),
              node(tool("eslint/bin/eslint.js"), "."),
              // What `npm run docs` would complain of.
              node(tool("typedoc/bin/typedoc"), "--emit", "none", "--logLevel", "Warn"),
          ];
    let failed = 0;
    const check = async (command, args) => {
        failed += (await run(command, args, { allowFailure: true })) === 0 ? 0 : 1;
    };
    for (const [command, args] of checks) {
        say(`» ${command === process.execPath ? args[0].split("/")[1] : command}`);
        await check(command, args);
    }
    if (!values.fix) {
        for (const project of ["wasm", "web", "tests"]) {
            if (existsSync(`${root}/${project}/tsconfig.json`)) {
                say(`» tsc ${project}`);
                await check(process.execPath, [
                    tool("typescript/bin/tsc"),
                    "--noEmit",
                    "-p",
                    project,
                ]);
            }
        }
    }
    if (values.tidy) {
        await tidy(
            cpp.filter((file) => file.endsWith(".cc")),
            check,
        );
    }
    if (failed > 0) {
        console.error(
            `\n${failed} checks failed${values.fix ? "" : "; npm run format mends some"}`,
        );
        return 1;
    }
    return 0;
});

/** clang-tidy reads how each file is compiled from the release build. */
async function tidy(sources, check) {
    await buildPreset("release");
    const compiled = output("cmake", ["-E", "cat", "build/release/compile_commands.json"]) ?? "";
    for (const file of sources.filter((source) => compiled.includes(`${root}/${source}`))) {
        say(`» clang-tidy ${file}`);
        await check("clang-tidy", ["-p", "build/release", "--quiet", file]);
    }
}
