// Runs one job of the core in slices that let other events be handled in between, and reads what
// it made.
import type { Core, Handle } from "./core.js";
import { drawnPaths } from "./drawn_paths.js";
import { LayoutError } from "./errors.js";
import { algorithmNames, pathShapeNames } from "./names.js";
import { assertNotDisposed, defaultSlice, pause } from "./slices.js";
import type {
    Algorithm,
    BoundaryEdges,
    BoundScope,
    EmbeddedEdge,
    EmbeddingPaths,
    EmbedEvent,
    EmbedEventKind,
    EmbedPhase,
    EmbedResult,
    EmbedStatus,
    LandmarkDoubt,
    PathConstraint,
    PathShape,
    Polylines,
    RefinedMesh,
    ReshapeOptions,
    SolveOptions,
    WeakPoint,
} from "./types.js";
import { flattenedWeakPaths } from "./weak_paths.js";

// In the order of the core's enumerations (core/apps/embed_job.hh).
const boundaryEdges: BoundaryEdges[] = ["free", "follow"];
const statuses: (EmbedStatus | "running" | "failed")[] = [
    "running",
    "optimal",
    "gapReached",
    "feasible",
    "timeLimit",
    "workLimit",
    "memoryLimit",
    "cancelled",
    "infeasible",
    "noneFound",
    "failed",
];
const scopes: BoundScope[] = ["embeddings", "insertionSequences"];
const phases: EmbedPhase[] = ["prepare", "search", "realise", "check", "done"];
const doubtKinds: LandmarkDoubt["kind"][] = ["mirrored", "exchanged"];
const eventKinds: EmbedEventKind[] = ["phase", "incumbent", "bound", "progress"];

const none = 0xffff_ffff;
const maximalWork = 0xffff_ffff_ffff_ffffn;
/** Numbers per event. */
const eventSize = 7;

/** What the core wants to know, checked and with all defaults filled in. */
export interface JobOptions {
    algorithm: Algorithm;
    gap: number;
    shape: PathShape;
    timeLimit: number;
    workLimit: number;
    memoryLimit: number;
    seed: number;
    boundaryEdges: BoundaryEdges;
    metric: { vertexCosts: Float64Array; featureDiscount: number; edgeWeights: Float64Array };
    constraints: readonly PathConstraint[];
    excluded: readonly EmbeddingPaths[];
    given: EmbeddingPaths;
    doubts: boolean;
}

/** Checks options; throws invalidOption. */
export function jobOptions(options: SolveOptions): JobOptions {
    const checked: JobOptions = {
        algorithm: options.algorithm ?? "exact",
        gap: options.gap ?? 0.01,
        shape: options.shape ?? "short",
        timeLimit: options.timeLimit ?? Infinity,
        workLimit: options.workLimit ?? Infinity,
        memoryLimit: options.memoryLimit ?? Infinity,
        seed: options.seed ?? 1,
        boundaryEdges: options.boundaryEdges ?? "free",
        metric: {
            vertexCosts: Float64Array.from(options.metric?.vertexCosts ?? []),
            featureDiscount: options.metric?.featureDiscount ?? 0,
            edgeWeights: Float64Array.from(options.metric?.edgeWeights ?? []),
        },
        constraints: options.constraints ?? [],
        excluded: options.excluded ?? [],
        given: options.given ?? [],
        doubts: options.doubts ?? true,
    };
    const refuse = (name: string, value: unknown, wanted: string) =>
        new LayoutError(
            "invalidOption",
            `the option ${name} is ${String(value)}; it has to be ${wanted}.`,
        );
    if (!algorithmNames.includes(checked.algorithm)) {
        throw refuse("algorithm", checked.algorithm, algorithmNames.join(" or "));
    }
    if (!pathShapeNames.includes(checked.shape)) {
        throw refuse("shape", checked.shape, pathShapeNames.join(", "));
    }
    if (!boundaryEdges.includes(checked.boundaryEdges)) {
        throw refuse("boundaryEdges", checked.boundaryEdges, boundaryEdges.join(" or "));
    }
    if (checked.boundaryEdges === "follow" && checked.algorithm !== "exact") {
        throw refuse("algorithm", checked.algorithm, "exact where edges follow the boundary");
    }
    if (!(checked.gap >= 0 && checked.gap <= 1)) {
        throw refuse("gap", checked.gap, "a number from 0 to 1");
    }
    for (const name of ["timeLimit", "workLimit", "memoryLimit"] as const) {
        if (!(checked[name] >= 0)) {
            throw refuse(name, checked[name], "a number that is not negative");
        }
    }
    if (!Number.isSafeInteger(checked.seed) || checked.seed < 0) {
        throw refuse("seed", checked.seed, "an integer from 0 to 2^53 - 1");
    }
    const { featureDiscount } = checked.metric;
    for (const name of ["vertexCosts", "edgeWeights"] as const) {
        const wrong = checked.metric[name].find((factor) => !(factor >= 0.001 && factor <= 1000));
        if (wrong !== undefined) {
            throw refuse(`metric.${name}`, wrong, "a list of numbers from 0.001 to 1000");
        }
    }
    if (!(featureDiscount >= 0 && featureDiscount <= 0.95)) {
        throw refuse("metric.featureDiscount", featureDiscount, "a number from 0 to 0.95");
    }
    if (typeof (checked.doubts as unknown) !== "boolean") {
        throw refuse("doubts", checked.doubts, "true or false");
    }
    for (const { rule, edge } of checked.constraints) {
        if ((rule as unknown) !== "keep" && (rule as unknown) !== "avoid") {
            throw refuse("constraints", rule, "a list of rules that are keep or avoid");
        }
        if (!Number.isSafeInteger(edge) || edge < 0 || edge >= none) {
            throw refuse("constraints", edge, "a list of rules for edges by their ids");
        }
    }
    if (checked.constraints.length > 0 && checked.algorithm !== "exact") {
        throw refuse("algorithm", checked.algorithm, "exact where paths are to be kept or avoided");
    }
    if (checked.excluded.length > 0 && checked.algorithm !== "exact") {
        throw refuse("algorithm", checked.algorithm, "exact where embeddings are excluded");
    }
    if (checked.given.length > 0 && checked.constraints.length + checked.excluded.length > 0) {
        throw refuse("given", "an embedding", "left out where routes or embeddings are ruled out");
    }
    return checked;
}

/** Makes a job; throws where layout, target and landmarks don't fit together. */
export function createJob(
    core: Core,
    layout: Handle,
    target: Handle,
    landmarks: Uint32Array,
    options: JobOptions,
): Handle {
    const { constraints, excluded, given, metric } = options;
    const refuse = (edge: number) =>
        new LayoutError(
            "invalidPath",
            `the path given for layout edge ${String(edge)} has a point without 1, 2 or 3 target ` +
                "vertices; take the weak path of an earlier embedding.",
            { edge },
        );
    const paths = flattenedWeakPaths(
        constraints.map(({ path }) => path),
        (place) => refuse(constraints[place]?.edge ?? 0),
    );
    const edges = excluded.flatMap((embedding) => embedding.map((_, edge) => edge));
    const excludedPaths = flattenedWeakPaths(
        excluded.flatMap((embedding) => embedding.map(({ weakPath }) => weakPath)),
        (place) => refuse(edges[place] ?? 0),
    );
    const givenPaths = flattenedWeakPaths(
        given.map(({ weakPath }) => weakPath),
        refuse,
    );
    return core.withCopies((copy) =>
        core.call(
            "boundary_job_create",
            layout,
            target,
            copy(landmarks),
            landmarks.length,
            algorithmNames.indexOf(options.algorithm),
            options.gap,
            BigInt(options.seed),
            options.timeLimit,
            workAmount(options.workLimit),
            options.memoryLimit,
            pathShapeNames.indexOf(options.shape),
            options.doubts ? 1 : 0,
            boundaryEdges.indexOf(options.boundaryEdges),
            copy(metric.vertexCosts),
            metric.vertexCosts.length,
            metric.featureDiscount,
            copy(Uint32Array.from(constraints, ({ edge }) => edge)),
            copy(Uint32Array.from(constraints, ({ rule }) => (rule === "keep" ? 1 : 0))),
            copy(paths.items),
            copy(paths.offsets),
            constraints.length,
            copy(metric.edgeWeights),
            metric.edgeWeights.length,
            copy(Uint32Array.from(excluded, ({ length }) => length)),
            copy(excludedPaths.items),
            copy(excludedPaths.offsets),
            excluded.length,
            copy(givenPaths.items),
            copy(givenPaths.offsets),
            given.length,
        ),
    );
}

/** Has a job that has ended start again with another shape; false where it has no embedding. */
export function reshapeJob(core: Core, job: Handle, shape: PathShape): boolean {
    return core.test("boundary_job_reshape", job, pathShapeNames.indexOf(shape));
}

/**
 * Steps the job to its end. `isAlive` is asked after every pause, in which the session may have
 * been disposed of.
 */
export async function runJob(
    core: Core,
    job: Handle,
    options: ReshapeOptions,
    isAlive: () => boolean,
): Promise<void> {
    const milliseconds = options.slice?.milliseconds ?? defaultSlice;
    const work = workAmount(options.slice?.work ?? Infinity);
    if (!(milliseconds > 0) || work === 0n) {
        throw new LayoutError("invalidOption", "a slice is empty; give it some time and work.");
    }
    core.call("boundary_job_events", job, 0);
    let seen = core.viewedDoubles().length / eventSize;
    for (let running = true; running;) {
        if (options.signal?.aborted === true) {
            core.call("boundary_job_cancel", job);
        }
        running = core.count("boundary_job_step", job, milliseconds, work) === 1;
        if (options.onProgress) {
            seen = reportProgress(core, job, seen, options.onProgress);
        }
        await pause();
        assertNotDisposed(isAlive);
    }
}

/** Everything about a job that has ended; throws the error of one that failed. */
export function readResult(
    core: Core,
    job: Handle,
    edges: Uint32Array,
    landmarks: Uint32Array,
): EmbedResult {
    core.call("boundary_job_state", job);
    const [status, scope, cost, lowerBound, gap, seconds, cpuSeconds, ...counts] =
        core.viewedDoubles() as unknown as number[];
    const name = statuses[status ?? 0] ?? "failed";
    if (name === "failed" || name === "running") {
        throw jobError(core, job);
    }
    core.call("boundary_job_exact", job);
    const [exactCost, exactLowerBound] = core.viewedLongs();
    core.call("boundary_job_insertion_order", job);
    const insertionOrder = core.viewedIds();
    const refined = readRefined(core, job);
    return {
        status: name,
        cost: cost ?? Infinity,
        lowerBound: lowerBound ?? 0,
        gap: gap ?? 1,
        boundScope: scopes[scope ?? 0] ?? "embeddings",
        exactCost: exactCost === undefined || exactCost === maximalWork ? null : exactCost,
        exactLowerBound: exactLowerBound ?? 0n,
        edges: refined === null ? [] : readEdges(core, job, edges, refined),
        refined,
        quality:
            refined === null
                ? null
                : { smallestAngle: counts[12] ?? 0, smallestArea: counts[13] ?? 0 },
        landmarks: landmarks.slice(),
        insertionOrder,
        events: readEvents(core, job, 0),
        counters: {
            work: counts[0] ?? 0,
            searches: counts[1] ?? 0,
            expansions: counts[2] ?? 0,
            fieldNodes: counts[3] ?? 0,
            insertions: counts[4] ?? 0,
            remembered: counts[5] ?? 0,
            statesCreated: counts[6] ?? 0,
            statesExpanded: counts[7] ?? 0,
            statesPruned: counts[8] ?? 0,
            statesRedundant: counts[9] ?? 0,
            deadEnds: counts[10] ?? 0,
            ties: counts[11] ?? 0,
        },
        doubts: readDoubts(core, job),
        seconds: seconds ?? 0,
        cpuSeconds: cpuSeconds ?? 0,
        message: name === "memoryLimit" ? jobError(core, job).message : null,
    };
}

function readDoubts(core: Core, job: Handle): LandmarkDoubt[] {
    core.call("boundary_job_doubts", job);
    const numbers = core.viewedDoubles();
    const doubts: LandmarkDoubt[] = [];
    for (let i = 0; i < numbers.length; i += 4) {
        const [kind, a, b, cost] = numbers.subarray(i, i + 4) as unknown as number[];
        core.call("boundary_job_doubt_message", job, i / 4);
        doubts.push({
            kind: doubtKinds[kind ?? 0] ?? "mirrored",
            vertices: a === undefined || b === undefined || a === none ? null : [a, b],
            cost: cost ?? Infinity,
            message: core.viewedText(),
        });
    }
    return doubts;
}

/** What stopped the job. */
function jobError(core: Core, job: Handle): LayoutError {
    core.call("boundary_job_error", job);
    return core.lastError();
}

/** Reports the last of the events from `seen` on, if there are any; the number of events now. */
function reportProgress(
    core: Core,
    job: Handle,
    seen: number,
    onProgress: NonNullable<SolveOptions["onProgress"]>,
): number {
    const events = readEvents(core, job, seen);
    const last = events.at(-1);
    if (last !== undefined) {
        const { phase, seconds, work, cost, lowerBound, progress } = last;
        const moved = events.some(
            (event) => event.kind === "incumbent" || event.kind === "progress",
        );
        const paths = moved ? readPaths(core, job) : null;
        onProgress({ phase, seconds, work, cost, lowerBound, progress, paths });
    }
    return seen + events.length;
}

function readEvents(core: Core, job: Handle, first: number): EmbedEvent[] {
    core.call("boundary_job_events", job, first);
    const numbers = core.viewedDoubles();
    const events: EmbedEvent[] = [];
    for (let i = 0; i < numbers.length; i += eventSize) {
        const [kind, phase, seconds, work, cost, lowerBound, progress] = numbers.subarray(
            i,
            i + eventSize,
        ) as unknown as [number, number, number, number, number, number, number];
        events.push({
            kind: eventKinds[kind] ?? "progress",
            phase: phases[phase] ?? "done",
            seconds,
            work,
            cost,
            lowerBound,
            progress,
        });
    }
    return events;
}

function readPaths(core: Core, job: Handle): Polylines {
    core.call("boundary_job_paths", job);
    return drawnPaths(core);
}

function readRefined(core: Core, job: Handle): RefinedMesh | null {
    if (!core.test("boundary_job_refined_positions", job)) {
        return null;
    }
    const positions = core.viewedDoubles(3);
    const ids = (name: string) => {
        core.call(`boundary_job_refined_${name}`, job);
        return core.viewedIds();
    };
    const corners = ids("corners");
    const patches = ids("triangle_patches");
    const triangleFaces = ids("triangle_faces");
    const vertexFaces = ids("vertex_faces");
    core.call("boundary_job_refined_vertex_barycentrics", job);
    return {
        positions,
        corners,
        // kNone, all bits set, becomes -1.
        patches: new Int32Array(patches.buffer),
        triangleFaces,
        vertexFaces,
        vertexBarycentrics: core.viewedDoubles(3),
    };
}

function readEdges(
    core: Core,
    job: Handle,
    layoutEdges: Uint32Array,
    refined: RefinedMesh,
): EmbeddedEdge[] {
    const ids = (name: string, size = 1) => {
        core.call(name, job);
        return core.viewedIds(size);
    };
    const chainOffsets = ids("boundary_job_chain_offsets");
    const chainVertices = ids("boundary_job_chain_vertices");
    const weakOffsets = ids("boundary_job_weak_offsets");
    const weakPoints = ids("boundary_job_weak_points", 3);
    const numbers = (name: string) => {
        core.call(name, job);
        return core.viewedDoubles();
    };
    const costs = numbers("boundary_job_edge_costs");
    const evenLengths = numbers("boundary_job_even_lengths");
    const edges: EmbeddedEdge[] = [];
    for (let id = 0; id < layoutEdges.length / 2; ++id) {
        const chain = chainVertices.slice(chainOffsets[id], chainOffsets[id + 1]);
        edges.push({
            id,
            layoutEdge: [layoutEdges[2 * id] ?? 0, layoutEdges[2 * id + 1] ?? 0],
            chain,
            cost: costs[id] ?? NaN,
            length: chainLength(refined.positions, chain),
            evenLength: evenLengths[id] ?? NaN,
            weakPath: weakPath(weakPoints, weakOffsets[id] ?? 0, weakOffsets[id + 1] ?? 0),
        });
    }
    return edges;
}

function weakPath(points: Uint32Array, begin: number, end: number): WeakPoint[] {
    const path: WeakPoint[] = [];
    for (let i = begin; i < end; ++i) {
        path.push(Array.from(points.subarray(3 * i, 3 * i + 3)).filter((id) => id !== none));
    }
    return path;
}

/** The length of a chain of mesh vertices. */
export function chainLength(positions: ArrayLike<number>, chain: ArrayLike<number>): number {
    let length = 0;
    for (let i = 1; i < chain.length; ++i) {
        let square = 0;
        for (let axis = 0; axis < 3; ++axis) {
            const from = positions[3 * (chain[i - 1] ?? 0) + axis] ?? NaN;
            const to = positions[3 * (chain[i] ?? 0) + axis] ?? NaN;
            square += (to - from) * (to - from);
        }
        length += Math.sqrt(square);
    }
    return length;
}

function workAmount(limit: number): bigint {
    return limit < 2 ** 63 ? BigInt(Math.floor(limit)) : maximalWork;
}
