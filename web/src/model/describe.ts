import type { Algorithm, EmbedPhase, EmbedResult, EmbedStatus } from "layout-embedding";

const numbers = new Intl.NumberFormat("en", { maximumSignificantDigits: 6 });
const counts = new Intl.NumberFormat("en");

/** A length or cost in target units. */
export const formatLength = (value: number): string =>
    Number.isFinite(value) ? numbers.format(value) : "–";

export const formatCount = (value: number, noun: string, plural = `${noun}s`): string =>
    `${counts.format(value)} ${value === 1 ? noun : plural}`;

export const formatGap = (gap: number): string =>
    gap === 0 ? "0 %" : `${(100 * gap).toFixed(gap < 0.001 ? 4 : 2)} %`;

export const formatSeconds = (seconds: number): string =>
    `${seconds.toFixed(seconds < 10 ? 2 : 1)} s`;

export const phaseWords: Record<EmbedPhase, string> = {
    prepare: "Preparing the path graph",
    search: "Searching",
    realise: "Cutting the mesh along the paths",
    check: "Checking the embedding",
    done: "Done",
};

/** The search phase once there is an embedding. */
export const improvingWords = "Looking for a shorter embedding";

const algorithmNames: Partial<Record<string, string>> = {
    greedy: "Shortest path first",
    praun: "Praun et al. 2001",
    kraevoy: "Kraevoy et al. 2003",
    schreiner: "Schreiner et al. 2004",
    "branch-and-bound": "Branch and bound",
    exact: "Exact",
};

export const algorithmWords = (algorithm: Algorithm): string =>
    algorithmNames[algorithm] ?? algorithm;

export const statusWords: Record<EmbedStatus, string> = {
    optimal: "Solved: proved to be the shortest",
    gapReached: "Solved to the gap asked for",
    feasible: "Solved; the search came to its end with this gap left",
    timeLimit: "Stopped at the time limit",
    workLimit: "Stopped at the work limit",
    memoryLimit: "Stopped at the memory limit",
    cancelled: "Cancelled",
    infeasible: "Proved: there is no embedding",
    noneFound: "No embedding was found",
};

/** What the figures of a result mean, in plain words. */
export function meaning(result: EmbedResult): string {
    const bound = formatLength(result.lowerBound);
    const scope =
        result.boundScope === "embeddings"
            ? "no embedding of this layout with these landmarks"
            : "no embedding made by inserting one path after another";
    const claim =
        `Measured along the edges of the target, each triangle cut in six, ${scope} ` +
        `can be shorter than ${bound} in all`;
    if (!Number.isFinite(result.cost)) return `${claim}.`;
    if (result.gap === 0) return `${claim}: this one cannot be improved.`;
    return `${claim}; this one is at most ${formatGap(result.gap)} of its length away from that.`;
}

/** A readable title for an error code, for example "Not triangles". */
export function titleOf(code: string): string {
    const words = code.replace(/[A-Z]/g, (letter) => ` ${letter.toLowerCase()}`);
    return words.charAt(0).toUpperCase() + words.slice(1);
}
