// How many lines of the core the C++ tests with sanitizers run through. `npm test` fails where that is
// too few; npm run coverage shows it by folder, with the files that are below the wanted share, as the
// last `npm test -- --only debug` has left it. The core's shapes, which no package has, do not count.
import { existsSync, mkdirSync, readdirSync, rmSync } from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { StepError, main, output, root, run, say } from "./run.mjs";
import { ensureSystemPackages } from "./system.mjs";

/** Percent of lines. */
const wanted = 90;

const build = path.join(root, "build/debug");
const profiles = path.join(build, "profiles");

/** Forgets earlier runs; the environment in which processes leave what they run through. */
export async function beginProfiles() {
    await ensureSystemPackages("coverage");
    rmSync(profiles, { recursive: true, force: true });
    mkdirSync(profiles, { recursive: true });
    // All processes of one program share a file.
    return { LLVM_PROFILE_FILE: path.join(profiles, "%m.profraw") };
}

/** Says what the processes since then have run through; a sentence where it is too little. */
export async function coverageProblems() {
    const share = shareOf(await filesOfCore());
    say(`the tests run through ${share.toFixed(1)} % of the core's lines (npm run coverage)`);
    return share < wanted
        ? [`the tests run through ${share.toFixed(1)} % of the core's lines, wanted ${wanted} %`]
        : [];
}

/** Name, lines and covered lines of each file. */
async function filesOfCore() {
    const isRaw = (name) => name.endsWith(".profraw");
    const raw = existsSync(profiles) ? readdirSync(profiles).filter(isRaw) : [];
    if (raw.length === 0) {
        throw new StepError("nothing has been measured yet: npm test -- --only debug does");
    }
    const merged = path.join(profiles, "all.profdata");
    const files = raw.map((name) => path.join(profiles, name));
    await run("llvm-profdata", ["merge", "-sparse", "-o", merged, ...files]);
    const program = path.join(build, "tests/core/core_tests");
    const json = output("llvm-cov", [
        "export",
        program,
        "-summary-only",
        `-instr-profile=${merged}`,
    ]);
    if (json === null) {
        throw new StepError("llvm-cov could not read the profile");
    }
    return JSON.parse(json)
        .data[0].files.map(({ filename, summary }) => ({
            name: path.relative(path.join(root, "core"), filename),
            lines: summary.lines.count,
            covered: summary.lines.covered,
        }))
        .filter(({ name }) => !/^(\.\.|shapes|.*tinyobjloader)/.test(name));
}

function shareOf(files) {
    const sum = (key) => files.reduce((total, file) => total + file[key], 0);
    return (100 * sum("covered")) / sum("lines");
}

function report(files) {
    const line = (name, list) => say(`${shareOf(list).toFixed(1).padStart(6)} %  ${name}`);
    const folders = new Set(files.map(({ name }) => path.dirname(name)));
    for (const folder of [...folders].sort()) {
        line(
            folder,
            files.filter(({ name }) => path.dirname(name) === folder),
        );
    }
    say(`\nFiles below ${wanted} %:`);
    const low = files.filter((file) => shareOf([file]) < wanted);
    for (const file of low.sort((a, b) => shareOf([a]) - shareOf([b]))) {
        line(file.name, [file]);
    }
    say("");
    line("of the core's lines", files);
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) {
    await main(async () => {
        await ensureSystemPackages("coverage");
        report(await filesOfCore());
        return 0;
    });
}
