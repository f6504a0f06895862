// The steps that make everything, each of which does only what changed; `npm run build` runs them.
import { existsSync, readFileSync, rmSync } from "node:fs";
import { availableParallelism } from "node:os";
import path from "node:path";
import { hashOf, main, once, root, run, runNpm, say } from "./run.mjs";
import { emscriptenRoot, ensureSystemPackages } from "./system.mjs";

/** Compilers and tests run side by side; each may want 2 GB. */
export const jobs = ["-j", String(Math.max(2, availableParallelism()))];

/** npm packages from the lockfile. */
export async function installPackages() {
    const manifests = [
        "package.json",
        "package-lock.json",
        "wasm/package.json",
        "web/package.json",
    ];
    const hash = hashOf(manifests, `${process.version} ${process.platform} ${process.arch}`);
    await once("node_modules/.installed", hash, ["node_modules"], async () => {
        say("» npm packages");
        await runNpm(["ci", "--no-audit", "--no-fund"]);
    });
}

/** Configures, if need be, and builds one of the presets in CMakePresets.json. */
export async function buildPreset(preset, { env = {}, targets = [] } = {}) {
    const folder = path.join("build", preset);
    const cache = path.join(root, folder, "CMakeCache.txt");
    // A build folder that came with a moved or copied project is of no use to CMake.
    if (existsSync(cache)) {
        const home = /^CMAKE_HOME_DIRECTORY:INTERNAL=(.*)$/m.exec(readFileSync(cache, "utf8"));
        if (home?.[1] !== root) {
            rmSync(path.join(root, folder), { recursive: true });
        }
    }
    say(`» ${preset} build`);
    const presets = hashOf(["CMakePresets.json"], JSON.stringify(env));
    await once(`${folder}/.configured`, presets, [`${folder}/build.ninja`], () =>
        run("cmake", ["--preset", preset, "--log-level=WARNING"], { env }),
    );
    const only = targets.length > 0 ? ["--target", ...targets] : [];
    await run("cmake", ["--build", "--preset", preset, ...jobs, ...only], { env });
}

/** The WebAssembly module and the TypeScript package around it, in wasm/dist. */
export async function buildPackage() {
    const sources = ["CMakeLists.txt", "CMakePresets.json", "core", "wasm", "tsconfig.base.json"];
    const hash = hashOf([...sources, "package-lock.json"], process.version);
    await once("build/stamps/package", hash, [commandLine()], async () => {
        await ensureSystemPackages("wasm");
        const tools = emscriptenRoot();
        await buildPreset("wasm", { env: { EMSCRIPTEN_ROOT: tools } });
        say("» TypeScript package");
        await runNpm(["run", "build", "--workspace", "wasm"]);
    });
}

/** The page, in web/dist. */
export async function buildPage() {
    const hash = hashOf(["web", "wasm", "core", "package-lock.json", "tsconfig.base.json"]);
    await once("build/stamps/page", hash, ["web/dist/index.html"], async () => {
        say("» page");
        await runNpm(["run", "build", "--workspace", "web"]);
    });
}

/** The package's command, relative to the root, as its package.json names it. */
export function commandLine() {
    const { bin } = JSON.parse(readFileSync(path.join(root, "wasm/package.json"), "utf8"));
    return path.join("wasm", typeof bin === "string" ? bin : bin["layout-embedding"]);
}

if (process.argv[1] === import.meta.filename) {
    await main(async () => {
        await installPackages();
        await buildPackage();
        await buildPage();
    });
}
