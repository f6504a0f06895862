import type {
    Algorithm,
    CandidatePaths,
    EmbedPhase,
    EmbedResult,
    EmbedStatus,
    PathShape,
} from "layout-embedding";
import { conflictsOf, edgesInConflict } from "./candidates.js";
import type { Contender, PathSettings } from "./state.js";

const numbers = new Intl.NumberFormat("en", { maximumSignificantDigits: 6 });
const counts = new Intl.NumberFormat("en");

/** A length or cost in target units. */
export const formatLength = (value: number): string =>
    Number.isFinite(value) ? numbers.format(value) : "–";

const figures = new Intl.NumberFormat("en", { maximumSignificantDigits: 4 });

/** A figure that nobody needs exactly. */
export const formatFigure = (value: number): string =>
    Number.isFinite(value) ? figures.format(value) : "–";

export const formatWhole = (value: number): string => counts.format(value);

export const formatCount = (value: number, noun: string, plural = `${noun}s`): string =>
    `${counts.format(value)} ${value === 1 ? noun : plural}`;

export const formatGap = (gap: number): string =>
    gap === 0 ? "0 %" : `${(100 * gap).toFixed(gap < 0.001 ? 4 : 2)} %`;

/** How much longer or shorter something is than before, with its sign. */
export const formatChange = (before: number, now: number): string =>
    `${now >= before ? "+" : "−"}${formatGap(Math.abs(now - before) / before)}`;

/** What comparing with the heuristics showed. */
export function comparisonWords(
    contenders: readonly Contender[],
    shown: number | null,
    { cost }: EmbedResult,
): string {
    const worst = shown === null ? null : contenders[shown];
    if (!worst?.result) return "All heuristics ended in a dead end.";
    const longer =
        worst.result.cost > cost
            ? `is ${formatGap((worst.result.cost - cost) / cost)} longer than the result`
            : "is as long as the result";
    return `The longest of ${contenders.length} heuristics, ${algorithmWords(worst.algorithm)}, ${longer}.`;
}

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

export const formatPercent = (share: number): string => `${Number((100 * share).toFixed(1))} %`;

/** What was made of the settings of paths. */
export function pathSettingWords({
    featureDiscount,
    boundaryEdges,
}: Partial<PathSettings>): string {
    if (featureDiscount !== undefined)
        return featureDiscount === 0
            ? "Sharp edges cost what all else costs."
            : `Along sharp edges paths cost up to ${formatPercent(featureDiscount)} less.`;
    return boundaryEdges === "follow"
        ? "Boundary edges follow the target's boundary."
        : "Boundary edges run where they are shortest.";
}

/** What the figures of a result mean, in plain words; `ruled`: with rules for single routes. */
export function meaning(
    result: EmbedResult,
    ruled: boolean,
    { featureDiscount, boundaryEdges }: PathSettings,
): string {
    const bound = formatLength(result.lowerBound);
    const kept = [
        ...(ruled ? ["rules for routes"] : []),
        ...(boundaryEdges === "follow" ? ["boundary edges along the boundary"] : []),
    ];
    const scope =
        result.boundScope === "embeddings"
            ? `no embedding of this layout with these landmarks${kept.map((words) => ` and ${words}`).join("")}`
            : "no embedding made by inserting one path after another";
    const features =
        featureDiscount > 0
            ? `, where sharp ones count up to ${formatPercent(featureDiscount)} less`
            : "";
    const claim =
        `Measured along the edges of the target, each triangle cut in six${features}, ${scope} ` +
        `can be shorter than ${bound} in all`;
    if (!Number.isFinite(result.cost)) return `${claim}.`;
    if (result.gap === 0) return `${claim}: this one cannot be improved.`;
    return `${claim}; this one is at most ${formatGap(result.gap)} of its length away from that.`;
}

/** What the candidate paths tell about an embedding. */
export function candidateWords(candidates: CandidatePaths, { cost }: EmbedResult): string {
    const sum = candidates.lengths.reduce((total, length) => total + length, 0);
    const conflicts = conflictsOf(candidates).length;
    if (conflicts === 0)
        return "Every edge takes the path here that it would take alone: none is in another's way.";
    const edges = edgesInConflict(candidates).size;
    return (
        `Each edge drawn as if it were alone: ${formatLength(sum)} in all, ` +
        `${formatGap((cost - sum) / cost)} less than the embedding. ` +
        `${formatCount(edges, "path")}, in red, cross or leave a landmark in the wrong order ` +
        `(${formatCount(conflicts, "conflict")}): they cannot all stay. Choose one to see which are in its way.`
    );
}

export const shapeWords: Record<PathShape, string> = {
    short: "Straight",
    even: "Evenly spaced",
    fair: "Fair to patches",
};

/** What is going on while paths get a shape. */
export const reshapeWords: Record<PathShape, string> = {
    short: "Pulling the paths straight",
    even: "Spacing the paths evenly",
    fair: "Evening the patches out",
};

const titles: Partial<Record<string, string>> = {
    fileEmpty: "The file is empty",
    unknownFormat: "The file's format is unknown",
    syntaxError: "The file cannot be understood",
    indexOutOfRange: "A face has a vertex that does not exist",
    faceTooLarge: "A face has too many corners",
    tooLarge: "The mesh is too large",
    noFaces: "The mesh has no faces",
    notTriangles: "The target is not made of triangles",
    nonFinitePosition: "A coordinate is no number",
    coordinateTooLarge: "Coordinates are out of proportion",
    degenerateFace: "A face has no area",
    duplicateFace: "A face is there twice",
    coincidentVertices: "Vertices lie on top of each other",
    unusedVertex: "A vertex belongs to no face",
    nonManifoldEdge: "More than two faces meet at an edge",
    nonManifoldVertex: "The surface touches itself at a vertex",
    inconsistentOrientation: "Neighbouring faces are turned against each other",
    severalComponents: "The mesh has several pieces",
    layoutLoop: "A layout edge ends where it begins",
    landmarkCount: "The number of landmarks does not fit",
    landmarkOutOfRange: "A landmark is not on the target",
    duplicateLandmark: "Two landmarks are in one place",
    landmarkOnBoundary: "A landmark is on the rim",
    topologyMismatch: "Layout and target do not fit together",
    tooFewLandmarks: "There are too few landmarks",
    tooFewLandmarksForSurface: "There are too few landmarks",
    templateNotReached: "No layout could be made",
    invalidOption: "A setting does not fit",
    memoryLimit: "There is too little memory",
    unresolvedTie: "Paths are exactly equally long",
    invalidPath: "A route to keep or avoid does not fit",
    realisationFailed: "The embedding could not be cut into the mesh",
    crashed: "The solver crashed",
    workerFailed: "The solver could not be started",
    workerTerminated: "The solver was stopped",
    moduleNotLoaded: "The solver could not be loaded",
    internal: "Something went wrong",
};

/**
 * The two halves of an error's sentence, "what and where; what to do.", each as a sentence. What is
 * only possible on the command line is left out.
 */
export function causeAndAdvice(message: string): { cause: string; advice: string } {
    const [, cause, advice] = /^(.*); (.*?)\.?$/s.exec(message) ?? [];
    if (!cause || !advice) return { cause: sentence(message), advice: "" };
    return { cause: sentence(cause), advice: sentence(advice.replace(/ \(--\w+\)/g, "")) };
}

/** Cause and advice of something thrown. */
export function sentencesOf(error: unknown): string {
    const { cause, advice } = causeAndAdvice(
        error instanceof Error ? error.message : String(error),
    );
    return `${cause} ${advice}`.trim();
}

/** The words with a full stop and, unless they begin with a file's name, a capital. */
export function sentence(words: string): string {
    const capital = words.replace(/^[a-z]+(?= )/, (word) => capitalised(word));
    return /[.!?]$/.test(capital) ? capital : `${capital}.`;
}

/** A title for an error code, for people; a code without one is spelled out: "Not triangles". */
export function titleOf(code: string): string {
    return (
        titles[code] ?? capitalised(code.replace(/[A-Z]/g, (letter) => ` ${letter.toLowerCase()}`))
    );
}

const capitalised = (words: string) => words.charAt(0).toUpperCase() + words.slice(1);
