// npm test: sets everything up, builds it, runs all tests and prints one summary, whose last line is
// "N passed, N failed, N skipped". A part that fails does not keep later parts from running.
//   npm test -- [--only PART]...      parts: release, debug, node, browser
import { mkdirSync, rmSync, writeFileSync } from "node:fs";
import path from "node:path";
import { parseArgs } from "node:util";
import { buildPackage, buildPage, buildPreset, installPackages } from "./build.mjs";
import { printSummary, readCtest, readVitest } from "./reports.mjs";
import { StepError, main, root, run, say } from "./run.mjs";
import { ensureSystemPackages } from "./system.mjs";

const results = path.join(root, "build/test-results");

/** The C++ tests of a preset, run by CTest. */
function ctest(preset, ...selection) {
    return async () => {
        await buildPreset(preset);
        const report = path.join(results, `${preset}.xml`);
        const reporting = ["--output-on-failure", "--no-tests=error", "--output-junit", report];
        const exitCode = await run(
            "ctest",
            ["--test-dir", `build/${preset}`, "-j", "2", ...selection, ...reporting],
            { allowFailure: true },
        );
        return { ...readCtest(report), exitCode };
    };
}

/** One of the projects in tests/vitest.config.ts, after the builds it needs. */
function vitest(project, ...builds) {
    return async () => {
        for (const build of builds) {
            await build();
        }
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
    // With sanitizers everything is an order of magnitude slower. Short fuzz runs are among them.
    debug: { name: "C++, sanitizers", run: ctest("debug", "-LE", "slow") },
    node: { name: "Node", run: vitest("node", buildPackage) },
    browser: { name: "Browser", run: vitest("browser", buildPackage, buildPage) },
};

await main(async () => {
    const chosen = choose();
    await ensureSystemPackages("native", "wasm", "test");
    await installPackages();
    rmSync(results, { recursive: true, force: true });
    mkdirSync(results, { recursive: true });
    const outcomes = [];
    for (const key of chosen) {
        const { name, run: runPart } = parts[key];
        say(`\n== ${name}`);
        const start = performance.now();
        let outcome;
        try {
            outcome = await runPart();
        } catch (error) {
            const message = error instanceof StepError ? error.message : error.stack;
            console.error(message);
            outcome = { tests: [], errors: [message], exitCode: 1 };
        }
        outcomes.push({ name, ...outcome, seconds: (performance.now() - start) / 1000 });
    }
    writeFileSync(path.join(results, "summary.json"), JSON.stringify(outcomes, null, 1));
    return printSummary(outcomes).failed > 0 ? 1 : 0;
});

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
