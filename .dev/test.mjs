// npm test: sets everything up, builds it, runs all tests and prints one summary, whose last line is
// "N passed, N failed, N skipped". A part that fails does not keep the others from running.
//   npm test -- [--only PART]...      parts: release, debug, node, browser
import { mkdirSync, rmSync, writeFileSync } from "node:fs";
import path from "node:path";
import { parseArgs } from "node:util";
import { buildPackage, buildPage, buildPreset, installPackages, jobs } from "./build.mjs";
import { beginProfiles, coverageProblems } from "./coverage.mjs";
import { printSummary, readCtest, readVitest } from "./reports.mjs";
import { StepError, inLane, main, root, run, say } from "./run.mjs";
import { ensureSystemPackages } from "./system.mjs";

const results = path.join(root, "build/test-results");

/** Builds that more than one part waits for are made once. */
const builds = new Map();
function built(key, build) {
    if (!builds.has(key)) {
        builds.set(key, build());
    }
    return builds.get(key);
}
const packageBuilt = () => built("package", buildPackage);
const presetBuilt = (preset) => built(preset, () => buildPreset(preset));

/** The C++ tests of a preset, run by CTest. */
function ctest(preset, selection = [], env = {}) {
    return async () => {
        await presetBuilt(preset);
        const report = path.join(results, `${preset}.xml`);
        // What every single test did is read from the logs, see reports.mjs: none may be cut short.
        const everything = ["passed", "failed"].flatMap((end) => [
            `--test-output-size-${end}`,
            "100000000",
        ]);
        const reporting = ["--output-on-failure", "--no-tests=error", "--output-junit", report];
        const exitCode = await run(
            "ctest",
            ["--test-dir", `build/${preset}`, ...jobs, ...selection, ...reporting, ...everything],
            { allowFailure: true, env },
        );
        return { ...readCtest(report), exitCode };
    };
}

/**
 * With sanitizers everything is an order of magnitude slower: only the quick tests, short fuzz runs
 * among them. How much of the core they run through is measured on the way.
 */
async function sanitizerTests() {
    const env = await beginProfiles();
    const outcome = await ctest("debug", ["-LE", "slow"], env)();
    return { ...outcome, errors: [...outcome.errors, ...(await coverageProblems())] };
}

/** One of the projects in tests/vitest.config.ts, after what it needs is built. */
function vitest(project, buildAll) {
    return async (chosen) => {
        await buildAll(chosen);
        const report = path.join(results, `${project}.json`);
        const program = path.join(root, "node_modules/vitest/vitest.mjs");
        const reporters = ["default", path.join(root, ".dev/vitest_reporter.mjs")];
        const exitCode = await run(
            process.execPath,
            [program, "run", "--config", "tests/vitest.config.ts", "--project", project].concat(
                reporters.map((reporter) => `--reporter=${reporter}`),
            ),
            { allowFailure: true, env: { LAYOUT_EMBEDDING_TEST_REPORT: report } },
        );
        return { ...readVitest(report), exitCode };
    };
}

const parts = {
    release: { name: "C++, release", run: ctest("release") },
    debug: { name: "C++, sanitizers", run: sanitizerTests },
    node: {
        name: "Node",
        run: vitest("node", async (chosen) => {
            await packageBuilt();
            // Some tests compare the package with the native build.
            if (chosen.includes("release")) {
                await presetBuilt("release");
            }
        }),
    },
    browser: {
        name: "Browser",
        run: vitest("browser", async () => {
            await packageBuilt();
            await buildPage();
        }),
    },
};

// Two lanes side by side: downloads, links and a browser that waits leave a core idle.
const lanes = [
    ["release", "debug"],
    ["browser", "node"],
];

await main(async () => {
    const chosen = choose();
    await ensureSystemPackages("native", "wasm", "test");
    await installPackages();
    rmSync(results, { recursive: true, force: true });
    mkdirSync(results, { recursive: true });
    const outcomes = new Map();
    const runLane = async (lane) => {
        for (const key of lane.filter((part) => chosen.includes(part))) {
            outcomes.set(key, await inLane(key.padEnd(7), () => runPart(key, chosen)));
        }
    };
    await Promise.all(lanes.map(runLane));
    const inOrder = chosen.map((key) => outcomes.get(key));
    writeFileSync(path.join(results, "summary.json"), JSON.stringify(inOrder, null, 1));
    return printSummary(inOrder).failed > 0 ? 1 : 0;
});

/** A part's outcome; one that cannot even be built has failed. */
async function runPart(key, chosen) {
    const { name, run: runTests } = parts[key];
    say(`== ${name}`);
    const start = performance.now();
    let outcome;
    try {
        outcome = await runTests(chosen);
    } catch (error) {
        const message = error instanceof StepError ? error.message : error.stack;
        say(message);
        outcome = { tests: [], errors: [message], exitCode: 1 };
    }
    return { name, ...outcome, seconds: (performance.now() - start) / 1000 };
}

function choose() {
    const { values } = parseArgs({ options: { only: { type: "string", multiple: true } } });
    for (const key of values.only ?? []) {
        if (!(key in parts)) {
            throw new StepError(
                `there is no part ${key}: choose from ${Object.keys(parts).join(", ")}`,
            );
        }
    }
    return Object.keys(parts).filter((key) => values.only?.includes(key) ?? true);
}
