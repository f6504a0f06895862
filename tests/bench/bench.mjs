// npm run bench: the same instances natively and in WebAssembly, side by side. Results must be the
// same in both, or it fails; see README.md for the options.
import { spawnSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import os from "node:os";
import path from "node:path";
import { parseArgs } from "node:util";
import { buildPackage, buildPreset, installPackages } from "../../.dev/build.mjs";
import { StepError, main, output, root } from "../../.dev/run.mjs";
import { ensureSystemPackages } from "../../.dev/system.mjs";
import { instances } from "./instances.mjs";

const baselineFile = path.join(import.meta.dirname, "baseline.json");
/** Seconds an instance may take in WebAssembly, from reading the files to the checked result. */
const timeLimit = 10;

const seconds = (value) => (value === undefined ? "-" : value.toFixed(2));
const columns = [
    ["instance", 18, ({ name }) => name],
    ["", 6, ({ where }) => where],
    ["status", 10, ({ status }) => status],
    ["cost", 10, ({ cost }) => cost?.toPrecision(7) ?? "-"],
    ["bound", 10, ({ lowerBound }) => lowerBound.toPrecision(7)],
    ["gap", 7, ({ gap }) => `${(100 * gap).toFixed(2)}%`],
    ["load", 6, ({ phases }) => seconds(phases.load)],
    ["search", 6, ({ phases }) => seconds((phases.prepare ?? 0) + (phases.search ?? 0))],
    ["real.", 6, ({ phases }) => seconds(phases.realise)],
    ["check", 6, ({ phases }) => seconds(phases.check)],
    ["total", 6, (result) => seconds(result.seconds)],
    ["CPU", 6, ({ cpuSeconds }) => seconds(cpuSeconds)],
    ["searches", 8, ({ counters }) => String(counters.searches)],
    ["expansions", 10, ({ counters }) => String(counters.expansions)],
    ["MB", 6, ({ peakMegabytes }) => peakMegabytes.toFixed(0)],
];

await main(async () => {
    const options = readOptions();
    const data = process.env.LAYOUT_EMBEDDING_DATA ?? path.join(root, "../shared");
    if (!existsSync(data)) {
        throw new StepError(`the data folder ${data} is missing; LAYOUT_EMBEDDING_DATA names it`);
    }
    await ensureSystemPackages("native", "wasm");
    await installPackages();
    await buildPreset("release", { targets: ["bench_embed"] });
    await buildPackage();

    const header = describeMachine();
    console.log(
        `\n${Object.entries(header)
            .map((line) => line.join(": "))
            .join("\n")}\n`,
    );
    console.log(row(columns.map(([title]) => title)));
    const results = [];
    const problems = [];
    for (const instance of instances.filter(({ quick }) => quick || !options.quick)) {
        const result = measure(instance, data);
        results.push(result);
        print(result);
        problems.push(...judge(result, options));
    }
    if (options.update) {
        const counts = results.map(({ name, native }) => [name, machineIndependent(native)]);
        const kept = options.quick ? readBaseline() : {};
        const baseline = { ...kept, ...Object.fromEntries(counts) };
        writeFileSync(baselineFile, `${JSON.stringify(baseline, null, 2)}\n`);
    }
    const folder = path.join(root, "bench-results");
    mkdirSync(folder, { recursive: true });
    const file = path.join(folder, `${header.date.replace(/[:.]/g, "-")}.json`);
    writeFileSync(file, `${JSON.stringify({ ...header, results, problems }, null, 1)}\n`);
    console.log(`\nwritten to ${path.relative(process.cwd(), file)}`);
    for (const problem of problems) {
        console.error(`FAILED  ${problem}`);
    }
    return problems.length > 0 ? 1 : 0;
});

function readOptions() {
    const flag = { type: "boolean", default: false };
    try {
        return parseArgs({ options: { quick: flag, compare: flag, check: flag, update: flag } })
            .values;
    } catch (error) {
        throw new StepError(error.message);
    }
}

/** Runs one instance both ways; either is { error } where it failed. */
function measure({ name, layout, target, landmarks, demanded = false }, data) {
    const place = (file) => path.join(data, file);
    const files = [place(layout), place(target)];
    const program = path.join(import.meta.dirname, "embed_wasm.mjs");
    const given = landmarks === undefined ? [] : [place(landmarks)];
    const { landmarks: used = [], ...wasm } = runJson(process.execPath, [
        program,
        ...files,
        ...given,
    ]);
    const native = runJson(path.join(root, "build/release/tests/bench/bench_embed"), files, {
        input: used.join("\n"),
    });
    return { name, demanded, native, wasm };
}

function runJson(command, args, options = {}) {
    const { status, stdout, stderr } = spawnSync(command, args, { ...options, encoding: "utf8" });
    try {
        return JSON.parse(stdout);
    } catch {
        return { error: stderr.trim() || `it ended with code ${status} and printed no result` };
    }
}

/** What is wrong with a result, as sentences. */
function judge({ name, demanded, native, wasm }, { compare, check }) {
    const problems = [];
    for (const [where, result] of Object.entries({ native, wasm })) {
        if (result.error !== undefined) {
            problems.push(`${name}, ${where}: ${result.error}`);
        } else if (result.cost === null || result.status === "failed") {
            problems.push(`${name}, ${where}: no embedding, status ${result.status}`);
        }
    }
    if (problems.length > 0) {
        return problems;
    }
    problems.push(...differences(`${name}: native and WASM`, native, wasm));
    if (compare) {
        const baseline = readBaseline()[name];
        if (baseline === undefined) {
            problems.push(`${name}: not in the baseline; --update adds it`);
        } else {
            problems.push(...differences(`${name}: baseline and now`, baseline, native));
        }
    }
    if (check && demanded && wasm.seconds > timeLimit) {
        problems.push(`${name}: ${wasm.seconds.toFixed(1)} s in WASM, more than ${timeLimit} s`);
    }
    return problems;
}

/** What has to be the same on every machine. */
function machineIndependent({ status, exactCost, exactLowerBound, counters }) {
    return { status, exactCost, exactLowerBound, ...counters };
}

function differences(what, a, b) {
    const before = a.counters === undefined ? a : machineIndependent(a);
    const after = machineIndependent(b);
    return Object.keys(before)
        .filter((key) => String(before[key]) !== String(after[key]))
        .map((key) => `${what} differ in ${key}: ${before[key]} and ${after[key]}`);
}

function readBaseline() {
    return existsSync(baselineFile) ? JSON.parse(readFileSync(baselineFile, "utf8")) : {};
}

function describeMachine() {
    const firstLine = (text) => text?.split("\n")[0] ?? "unknown";
    const flags = (preset) => {
        const commands = JSON.parse(
            readFileSync(path.join(root, "build", preset, "compile_commands.json"), "utf8"),
        );
        const [compiler, ...args] = commands
            .find(({ file }) => file.endsWith("embed_job.cc"))
            .command.split(/\s+/);
        const shown = args.filter((arg) => /^-(O|D|f|std|m|W)/.test(arg));
        return `${firstLine(output(compiler, ["--version"]))}, ${shown.join(" ")}`;
    };
    return {
        date: new Date().toISOString(),
        revision: output("git", ["describe", "--always", "--dirty"]) ?? "unknown",
        machine: `${os.cpus()[0]?.model ?? "unknown"}, ${os.cpus().length} cores, ${(os.totalmem() / 2 ** 30).toFixed(1)} GB, load ${os.loadavg()[0].toFixed(1)}`,
        system: `${os.type()} ${os.release()}, Node ${process.version}`,
        native: flags("release"),
        wasm: flags("wasm"),
        times: "seconds by the clock for load, search, realise, check and in total; CPU seconds and peak memory (MB) of the process, for WASM with Node's own",
    };
}

function row(cells) {
    return cells
        .map((cell, i) => (i < 3 ? cell.padEnd(columns[i][1]) : cell.padStart(columns[i][1])))
        .join(" ");
}

function print({ name, native, wasm }) {
    for (const [where, result] of Object.entries({ native, wasm })) {
        const line = { name: where === "native" ? name : "", where, ...result };
        console.log(
            result.error === undefined
                ? row(columns.map(([, , cell]) => cell(line)))
                : `${row([line.name, where])} ${result.error}`,
        );
    }
}
