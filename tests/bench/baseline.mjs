// The committed counts that --compare compares with. They do not depend on the machine, but on the
// algorithm, and on the limit on its work where that ended the search.
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";

const file = path.join(import.meta.dirname, "baseline.json");

/** What has to be the same on every machine. */
export function machineIndependent(result, workLimit) {
    const { status, exactCost = null, exactLowerBound, counters } = result;
    const limit = status === "workLimit" ? { workLimit } : {};
    return { status, ...limit, exactCost, exactLowerBound, ...counters };
}

/** One sentence per count that differs. */
export function differences(before, after) {
    const keys = new Set([...Object.keys(before), ...Object.keys(after)]);
    return [...keys]
        .filter((key) => String(before[key]) !== String(after[key]))
        .map((key) => {
            const change = (100 * (Number(after[key]) - Number(before[key]))) / before[key];
            const percent = Number.isFinite(change)
                ? ` (${change > 0 ? "+" : ""}${change.toFixed(change < 1 && change > -1 ? 4 : 1)} %)`
                : "";
            return `${key} ${before[key] ?? "none"} -> ${after[key] ?? "none"}${percent}`;
        });
}

/** All counts: algorithm -> instance -> counts. */
function read() {
    return existsSync(file) ? JSON.parse(readFileSync(file, "utf8")) : {};
}

/** What differs between a result and the baseline, as sentences. */
export function compare(name, result, workLimit) {
    const before = read()[result.algorithm]?.[name];
    if (before === undefined) {
        return [`not in the baseline for ${result.algorithm}; --update adds it`];
    }
    return differences(before, machineIndependent(result, workLimit));
}

/** Puts a result into the baseline; all others stay. */
export function update(name, result, workLimit) {
    const baseline = read();
    baseline[result.algorithm] ??= {};
    baseline[result.algorithm][name] = machineIndependent(result, workLimit);
    writeFileSync(file, `${JSON.stringify(baseline, null, 2)}\n`);
}
