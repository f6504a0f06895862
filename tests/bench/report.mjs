// What the benchmark prints: the machine, one row per instance and build, the verdict of --check.
import { existsSync, readFileSync } from "node:fs";
import os from "node:os";
import path from "node:path";
import { output, root } from "../../.dev/run.mjs";
import { ratio } from "./criteria.mjs";

const seconds = (value) => value?.toFixed(2) ?? "-";
const megabytes = (value) => value?.toFixed(0) ?? "-";
const count = (value) => value?.toString() ?? "-";

// Title, width, cell.
const columns = [
    ["instance", 19, ({ name }) => name],
    ["", 6, ({ where }) => where],
    ["status", 10, ({ status }) => status],
    ["cost", 9, ({ cost }) => cost?.toPrecision(7) ?? "-"],
    ["bound", 9, ({ lowerBound }) => lowerBound.toPrecision(7)],
    ["gap", 7, ({ gap }) => `${(100 * gap).toFixed(2)}%`],
    ["best", 6, ({ cpu }) => seconds(cpu.best)],
    ["end", 6, ({ cpu }) => seconds(cpu.end)],
    ["job", 6, ({ cpu }) => seconds(cpu.total)],
    ["load", 5, ({ cpu }) => seconds(cpu.load)],
    ["states", 7, ({ counters }) => count(counters.statesExpanded)],
    ["searches", 8, ({ counters }) => count(counters.searches)],
    ["expansions", 10, ({ counters }) => count(counters.expansions)],
    ["search MB", 9, ({ memory }) => megabytes(memory.search)],
    ["MB", 5, ({ memory }) => megabytes(memory.peak)],
    ["again", 6, ({ cpu }) => seconds(cpu.again)],
    ["ratio", 5, ({ ratio }) => seconds(ratio)],
];

const explanation = [
    "best, end: CPU seconds from the start of the job to its best embedding and to the end of the",
    "search; job: to the checked result; load: reading before that. Native: of the process; WASM:",
    "of the thread that runs it, best and end in proportion to the clock. search MB: peak of the",
    "search over what was loaded; MB: peak of the process, for WASM of the module's memory. again:",
    "the same job once more in the same WASM instance, where it is short and the engine was still",
    "compiling the first time. ratio: of that, or of the job, to the job natively. Short jobs run",
    "up to three times, of which the quickest counts.",
];

export function describeMachine(builds) {
    const firstLine = (text) => text?.split("\n")[0] ?? "unknown";
    const flags = (preset) => {
        const file = path.join(root, "build", preset, "compile_commands.json");
        if (!existsSync(file)) {
            return "built elsewhere";
        }
        const commands = JSON.parse(readFileSync(file, "utf8"));
        const [compiler, ...args] = commands
            .find(({ command }) => command.includes("core/CMakeFiles/layout_embedding.dir"))
            .command.split(/\s+/);
        const shown = args.filter((arg) => /^-(O|D|f|std|m|W)/.test(arg));
        return `${firstLine(output(compiler, ["--version"]))}, ${shown.join(" ")}`;
    };
    const memory = (os.totalmem() / 2 ** 30).toFixed(1);
    return {
        date: new Date().toISOString(),
        revision: output("git", ["describe", "--always", "--dirty"]) ?? "unknown",
        machine: `${os.cpus()[0]?.model ?? "unknown"}, ${os.cpus().length} cores, ${memory} GB, load ${os.loadavg()[0].toFixed(1)}`,
        system: `${os.type()} ${os.release()}, Node ${process.version}`,
        ...(builds.includes("native") ? { native: flags("release") } : {}),
        ...(builds.includes("wasm") ? { wasm: flags("wasm") } : {}),
    };
}

export function printHeader(header) {
    const lines = Object.entries(header).map((line) => line.join(": "));
    console.log(["", ...lines, "", ...explanation, ""].join("\n"));
    console.log(row(columns.map(([title]) => title)));
}

function row(cells) {
    return cells
        .map((cell, i) => (i < 3 ? cell.padEnd(columns[i][1]) : cell.padStart(columns[i][1])))
        .join(" ")
        .trimEnd();
}

/** A row for each build that was run. */
export function printResult({ name, native, wasm }) {
    const relative = native?.cpu && wasm?.cpu ? ratio({ native, wasm }) : undefined;
    let first = true;
    for (const [where, result] of Object.entries({ native, wasm })) {
        if (result !== undefined) {
            const line = { name: first ? name : "", where, ...result };
            console.log(
                result.error === undefined
                    ? row(
                          columns.map(([, , cell]) =>
                              cell({ ...line, ratio: where === "wasm" ? relative : undefined }),
                          ),
                      )
                    : `${row([line.name, where])} ${result.error}`,
            );
            first = false;
        }
    }
}

export function printVerdict(verdict) {
    console.log("\ncriteria");
    const shown = (value, unit) =>
        Number.isFinite(value) ? `${value.toFixed(3)} ${unit}`.trimEnd() : "not reached";
    for (const { title, limit, unit, cases, passed } of verdict) {
        const limitText = `at most ${limit} ${unit}`.trimEnd();
        if (cases.length === 0) {
            console.log(`not run  ${title}, ${limitText}`);
            continue;
        }
        const good = cases.filter((one) => one.passed).length;
        const worst = cases.reduce((a, b) => (b.value > a.value ? b : a));
        console.log(
            `${passed ? "pass   " : "FAIL   "}  ${title}, ${limitText}: ${good} of ${cases.length}; worst ${shown(worst.value, unit)} (${worst.name})`,
        );
        for (const { name, value } of cases.filter((one) => !one.passed)) {
            console.log(`           ${name}: ${shown(value, unit)}`);
        }
    }
}
