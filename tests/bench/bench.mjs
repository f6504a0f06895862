// npm run bench: the same instances natively and in WebAssembly, side by side. Results must be the
// same in both, or it fails; see README.md for the options.
import { spawnSync } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import path from "node:path";
import { parseArgs } from "node:util";
import { buildPackage, buildPreset, installPackages } from "../../.dev/build.mjs";
import { StepError, main, root } from "../../.dev/run.mjs";
import { ensureSystemPackages } from "../../.dev/system.mjs";
import { compare, differences, machineIndependent, update } from "./baseline.mjs";
import { judge, judgeCancel } from "./criteria.mjs";
import { filesOf, instances } from "./instances.mjs";
import { runsOf } from "./process.mjs";
import { describeMachine, printHeader, printResult, printVerdict } from "./report.mjs";

/**
 * Units of work that the native build does in a CPU second, about: the limit on an instance is one
 * on its work, so that counts are the same on every machine.
 */
const workPerSecond = 4_000_000;

const programs = {
    native: [path.join(root, "build/release/tests/bench/bench_embed")],
    wasm: [process.execPath, path.join(import.meta.dirname, "embed_wasm.mjs")],
};

await main(async () => {
    const options = readOptions();
    const data = process.env.LAYOUT_EMBEDDING_DATA ?? path.join(root, "../shared");
    const builds = options.only === undefined ? ["native", "wasm"] : [options.only];
    const chosen = instances.filter(
        ({ name, quick }) => (quick || !options.quick) && name.includes(options.filter),
    );
    if (chosen.length === 0) {
        throw new StepError(`no instance has "${options.filter}" in its name`);
    }
    await ensureSystemPackages(...builds);
    await installPackages();
    if (builds.includes("native")) {
        await buildPreset("release", { targets: ["bench_embed"] });
    }
    if (builds.includes("wasm")) {
        await buildPackage();
    }

    const workLimit = Math.round(options.limit * workPerSecond);
    const header = { ...describeMachine(builds), workLimit };
    printHeader(header);
    const results = [];
    const problems = [];
    const missing = [];
    for (const instance of chosen) {
        const files = await filesOf(instance, data);
        if (files.missing !== undefined) {
            missing.push(files.missing);
            continue;
        }
        const { name } = instance;
        const result = { name, instance };
        for (const build of builds) {
            result[build] = measure(build, files, workLimit, options);
        }
        printResult(result);
        results.push(result);
        problems.push(...problemsOf(result, builds, workLimit, options));
        // At once, so that a run that is stopped keeps what it has.
        if (options.update && builds.every((build) => !result[build].error)) {
            update(name, result[builds[0]], workLimit);
        }
        write(header, results, problems);
    }
    if (missing.length > 0) {
        console.log(
            `\nskipped ${missing.length} instances: ${missing[0]}${missing.length > 1 ? " and others are" : " is"} missing; LAYOUT_EMBEDDING_DATA names the folder that has them`,
        );
    }
    if (results.length === 0) {
        throw new StepError("no instance was run, so nothing was measured");
    }
    const verdict = options.check ? judge(results) : [];
    if (options.check && builds.includes("wasm") && options.filter === "") {
        // Imports the package, which has to be built before.
        const { cancelTimes } = await import("./cancel.mjs");
        verdict.push(judgeCancel(await cancelTimes()));
    }
    if (options.check) {
        printVerdict(verdict);
    }
    const file = write(header, results, problems, verdict);
    console.log(`\nwritten to ${path.relative(process.cwd(), file)}`);
    for (const problem of problems) {
        console.error(`FAILED  ${problem}`);
    }
    return problems.length > 0 || verdict.some(({ passed }) => !passed) ? 1 : 0;
});

function readOptions() {
    const flag = { type: "boolean", default: false };
    const text = { type: "string" };
    let values;
    try {
        ({ values } = parseArgs({
            options: {
                quick: flag,
                compare: flag,
                check: flag,
                update: flag,
                algorithm: { type: "string", default: "exact" },
                gap: { type: "string", default: "0" },
                filter: { type: "string", default: "" },
                only: text,
                limit: { type: "string", default: "20" },
            },
        }));
    } catch (error) {
        throw new StepError(error.message);
    }
    const limit = Number(values.limit);
    if (!(limit > 0 && limit < 1e6)) {
        throw new StepError(`--limit ${values.limit} has to be a number of seconds`);
    }
    if (values.only !== undefined && programs[values.only] === undefined) {
        throw new StepError(`--only ${values.only} has to be native or wasm`);
    }
    if (!(Number(values.gap) >= 0 && Number(values.gap) < 1)) {
        throw new StepError(`--gap ${values.gap} has to be a number from 0 to 1`);
    }
    return { ...values, limit };
}

/** The quickest of some runs of one instance in one build; { error } where one failed. */
function measure(build, files, workLimit, options) {
    const first = measureOnce(programs[build], files, workLimit, options);
    const results = [first];
    // The WASM program does this itself.
    for (let run = 1; build === "native" && run < runsOf(first.cpu?.total); ++run) {
        results.push(measureOnce(programs[build], files, workLimit, options));
    }
    return (
        results.find(({ error }) => error !== undefined) ??
        results.reduce((a, b) => (b.cpu.total < a.cpu.total ? b : a))
    );
}

/** Runs one instance in one build; { error } where that failed. */
function measureOnce([program, ...first], { layout, target, landmarks }, workLimit, options) {
    const { algorithm, gap } = options;
    const args = [...first, layout, target, landmarks, String(workLimit), algorithm, gap];
    // Only for what hangs: the limit on work ends it long before.
    const timeout = 1000 * (300 + 20 * options.limit);
    const { status, signal, stdout, stderr } = spawnSync(program, args, {
        encoding: "utf8",
        maxBuffer: 2 ** 30,
        timeout,
    });
    try {
        return JSON.parse(stdout);
    } catch {
        const end = signal === null ? `ended with code ${status}` : `was stopped by ${signal}`;
        return { error: stderr.trim() || `it ${end} and printed no result` };
    }
}

/** What is wrong with a result, as sentences. That no embedding was found is not wrong. */
function problemsOf(result, builds, workLimit, options) {
    const { name, native, wasm } = result;
    const problems = [];
    for (const build of builds) {
        const { error, status, cost, valid } = result[build];
        if (error !== undefined) {
            problems.push(`${name}, ${build}: ${error}`);
        } else if (status === "failed" || (cost !== null && !valid)) {
            problems.push(`${name}, ${build}: an embedding that is not valid, status ${status}`);
        }
    }
    if (problems.length > 0) {
        return problems;
    }
    if (native && wasm) {
        const [one, other] = [native, wasm].map((build) => machineIndependent(build, workLimit));
        problems.push(...differences(one, other).map((text) => `${name}, native to WASM: ${text}`));
    }
    if (options.compare) {
        const changes = compare(name, result[builds[0]], workLimit);
        problems.push(...changes.map((text) => `${name}, baseline to now: ${text}`));
    }
    return problems;
}

function write(header, results, problems, verdict = []) {
    const folder = path.join(root, "bench-results");
    mkdirSync(folder, { recursive: true });
    const file = path.join(folder, `${header.date.replace(/[:.]/g, "-")}.json`);
    const shown = results.map(({ instance, ...rest }) => ({ family: instance.family, ...rest }));
    const all = { ...header, results: shown, problems, criteria: verdict };
    writeFileSync(file, `${JSON.stringify(all, null, 1)}\n`);
    return file;
}
