// npm run coverage: how many lines of the core the quick C++ tests run through, by folder, and the
// files that are below the wanted share; fails where the whole core is. The core's shapes, which no
// package has, do not count.
import { mkdirSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import path from "node:path";
import { buildPreset, jobs } from "./build.mjs";
import { StepError, main, output, root, run, say } from "./run.mjs";
import { ensureSystemPackages } from "./system.mjs";

/** Percent of lines. */
const wanted = 90;

const build = "build/coverage";
const profiles = path.join(root, build, "profiles");

await main(async () => {
    await ensureSystemPackages("native", "test", "coverage");
    await buildPreset("coverage", { targets: ["core_tests"] });
    rmSync(profiles, { recursive: true, force: true });
    mkdirSync(profiles);
    say("» tests");
    // Every process writes a file of its own.
    const env = { LLVM_PROFILE_FILE: path.join(profiles, "%p.profraw") };
    const folder = path.join(build, "tests/core");
    const ctest = ["--test-dir", folder, ...jobs, "-LE", "slow", "--output-on-failure"];
    await run("ctest", [...ctest, "--quiet"], { env });

    const merged = path.join(profiles, "all.profdata");
    const raw = readdirSync(profiles).map((name) => path.join(profiles, name));
    await run("llvm-profdata", ["merge", "-sparse", "-o", merged, ...raw]);
    const program = path.join(folder, "core_tests");
    const options = ["-summary-only", `-instr-profile=${merged}`];
    const json = output("llvm-cov", ["export", program, ...options]);
    if (json === null) {
        throw new StepError("llvm-cov could not read the profile");
    }
    writeFileSync(path.join(root, build, "coverage.json"), json);
    return report(filesOfCore(JSON.parse(json)));
});

/** Name, lines and covered lines of each file. */
function filesOfCore({ data }) {
    return data[0].files
        .map(({ filename, summary }) => ({
            name: path.relative(path.join(root, "core"), filename),
            lines: summary.lines.count,
            covered: summary.lines.covered,
        }))
        .filter(({ name }) => !/^(\.\.|shapes|.*tinyobjloader)/.test(name));
}

function report(files) {
    const share = (list) => {
        const sum = (key) => list.reduce((total, file) => total + file[key], 0);
        return (100 * sum("covered")) / sum("lines");
    };
    const line = (name, list) => say(`${share(list).toFixed(1).padStart(6)} %  ${name}`);
    const folders = new Set(files.map(({ name }) => path.dirname(name)));
    for (const folder of [...folders].sort()) {
        line(
            folder,
            files.filter(({ name }) => path.dirname(name) === folder),
        );
    }
    say(`\nFiles below ${wanted} %:`);
    const low = files.filter((file) => share([file]) < wanted);
    for (const file of low.sort((a, b) => share([a]) - share([b]))) {
        line(file.name, [file]);
    }
    say("");
    line("of the core's lines", files);
    return share(files) >= wanted ? 0 : 1;
}
