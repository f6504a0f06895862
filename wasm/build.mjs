// Compiles the TypeScript to dist/ and puts core.wasm, built by CMake's wasm preset, beside it, as it
// is and as text in a module.
import { spawnSync } from "node:child_process";
import { chmodSync, copyFileSync, existsSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const here = fileURLToPath(new URL(".", import.meta.url));
const core = path.join(here, "../build/wasm/wasm/core.wasm");
if (!existsSync(core)) {
    console.error("error: core.wasm is missing; build the wasm preset first (npm run build does)");
    process.exit(1);
}
rmSync(path.join(here, "dist"), { recursive: true, force: true });
const compiler = createRequire(import.meta.url).resolve("typescript/bin/tsc");
const { status } = spawnSync(process.execPath, [compiler, "-p", here], { stdio: "inherit" });
if (status !== 0) {
    process.exit(status ?? 1);
}
copyFileSync(core, path.join(here, "dist/core.wasm"));
const text = gzipSync(readFileSync(core), { level: 9 }).toString("base64");
writeFileSync(path.join(here, "dist/core_base64.js"), `export const gzippedCore = "${text}";\n`);
chmodSync(path.join(here, "dist/cli.js"), 0o755);
// npm packs only what lies in the package's own folder.
copyFileSync(path.join(here, "../LICENSE"), path.join(here, "LICENSE"));
