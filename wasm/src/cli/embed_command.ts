// layout-embedding embed
import { LayoutError } from "../errors.js";
import { jsonBytes, type EmbeddingDocument } from "../files.js";
import { Session } from "../session.js";
import type {
    EmbedResult,
    LayoutInfo,
    PathConstraint,
    PathMetric,
    QuadMesh,
    QualityReport,
    SolveOptions,
    TargetInfo,
} from "../types.js";
import type { EmbedCommand } from "./arguments.js";
import { readInput, readFactors, readReference } from "./input_files.js";
import { exitCodes, type Outcome } from "./outcome.js";
import { OutputFolder } from "./output_folder.js";
import { ProgressLine } from "./progress.js";
import { readDocument, type CheckedDocument } from "./read_embedding.js";

export async function runEmbed(command: EmbedCommand): Promise<Outcome> {
    // The first interruption ends the search, a second one the program.
    const interrupt = new AbortController();
    const stop = () => {
        interrupt.abort();
    };
    process.once("SIGINT", stop);
    process.once("SIGTERM", stop);
    const output = command.output === null ? null : await OutputFolder.prepare(command.output);
    const session = await Session.create();
    try {
        const previous = command.previous && (await readDocument(command.previous.folder));
        const excluded = await Promise.all(command.excluded.map(readDocument));
        const loaded = await load(session, command, previous ?? excluded[0] ?? null);
        const asked = {
            constraints: constraintsOf(command, previous),
            excluded: excluded.map(({ edges }) => edges),
            metric: await metricOf(command, loaded),
        };
        const result = await solve(session, command, asked, interrupt.signal);
        return await finish(session, command, output, result, interrupt.signal.aborted);
    } finally {
        await session.dispose();
        await output?.leave();
        process.off("SIGINT", stop);
        process.off("SIGTERM", stop);
    }
}

interface Loaded {
    layout: LayoutInfo;
    target: TargetInfo;
}

async function load(
    session: Session,
    command: EmbedCommand,
    previous: CheckedDocument | null,
): Promise<Loaded> {
    const reference = command.target === "" ? await readReference(command.layout) : null;
    const layout = await readInput("the layout", reference?.layout ?? command.layout);
    const target = await readInput("the target", reference?.target ?? command.target);
    const file =
        command.landmarks === null ? null : await readInput("the landmark file", command.landmarks);
    const options = { repair: command.repair };
    const loaded = {
        layout: await session.loadLayout(layout, options),
        target: await session.loadTarget(target, {
            ...options,
            attributes: command.attributes,
        }),
    };
    const notes = [...loaded.layout.notes, ...loaded.target.notes];
    if (file === null && previous !== null) {
        await session.setLandmarks(previous.landmarks, { numbering: "loaded" });
        printNotes(command, notes);
        return loaded;
    }
    const { vertexMap, vertexCount } = loaded.layout;
    const landmarks = file ?? reference?.landmarks(vertexMap?.length ?? vertexCount) ?? null;
    notes.push(
        ...(landmarks === null
            ? await session.landmarksByProximity()
            : await session.setLandmarks(landmarks)
        ).notes,
    );
    printNotes(command, notes);
    return loaded;
}

async function metricOf(
    { solve, vertexCosts, edgeWeights }: EmbedCommand,
    { layout, target }: Loaded,
): Promise<PathMetric> {
    return {
        ...solve.metric,
        ...(vertexCosts === null ? {} : { vertexCosts: await costsOf(vertexCosts, target) }),
        ...(edgeWeights === null
            ? {}
            : {
                  edgeWeights: await readFactors(
                      "edgeWeights",
                      edgeWeights,
                      layout.edges.length / 2,
                  ),
              }),
    };
}

/** The file's costs are those of its vertices before a repair. */
async function costsOf(
    file: string,
    { vertexCount, vertexMap }: TargetInfo,
): Promise<Float64Array> {
    const costs = await readFactors("vertexCosts", file, vertexMap?.length ?? vertexCount);
    const vertexCosts = new Float64Array(vertexCount);
    for (const [i, cost] of costs.entries()) {
        const vertex = vertexMap === null ? i : (vertexMap[i] ?? -1);
        if (vertex >= 0) {
            vertexCosts[vertex] = cost;
        }
    }
    return vertexCosts;
}

function printNotes(command: EmbedCommand, notes: string[]): void {
    if (!command.quiet && !command.json) {
        for (const note of notes) {
            process.stderr.write(`note: ${note}\n`);
        }
    }
}

/** Throws where an edge is none of the earlier output. */
function constraintsOf(command: EmbedCommand, previous: CheckedDocument | null): PathConstraint[] {
    const { keep = [], avoid = [] } = command.previous ?? {};
    const along = (rule: PathConstraint["rule"]) => (edge: number) => {
        const path = previous?.edges.find(({ id }) => id === edge)?.weakPath;
        if (path === undefined) {
            throw new LayoutError(
                "invalidOption",
                `--${rule} has ${String(edge)}, which is no edge of the earlier output; give one of ` +
                    `its ${String(previous?.edges.length ?? 0)} edges.`,
            );
        }
        return { rule, edge, path };
    };
    return [...keep.map(along("keep")), ...avoid.map(along("avoid"))];
}

async function solve(
    session: Session,
    command: EmbedCommand,
    asked: Pick<SolveOptions, "constraints" | "excluded" | "metric">,
    signal: AbortSignal,
): Promise<EmbedResult> {
    const line = new ProgressLine(process.stderr.isTTY && !command.quiet);
    try {
        return await session.solve({
            ...command.solve,
            ...asked,
            signal,
            onProgress: (progress) => {
                line.show(progress);
            },
        });
    } finally {
        line.clear();
    }
}

async function finish(
    session: Session,
    command: EmbedCommand,
    output: OutputFolder | null,
    result: EmbedResult,
    interrupted: boolean,
): Promise<Outcome> {
    const document = session.embeddingDocument();
    printNotes(
        command,
        result.doubts.map(({ message }) => message),
    );
    if (result.refined === null) {
        return {
            exitCode: interrupted ? exitCodes.interrupted : exitCodeWithout(result, command),
            text: command.quiet ? "" : failureText(result),
            document,
        };
    }
    const quads = command.quads === null ? null : await session.quads(command.quads);
    const report = command.report ? await session.qualityReport() : null;
    const files =
        output === null
            ? []
            : await output.write({
                  ...(await session.exportFiles()),
                  ...(await session.exportAs(command.formats, command.view)),
                  ...(quads === null ? {} : { "quads.obj": quads.obj }),
                  ...(report === null ? {} : { "report.json": jsonBytes(report) }),
              });
    const summary = [
        ...(quads === null ? [] : [quadText(quads)]),
        ...(report === null ? [] : [reportText(report)]),
        summaryText(document, files),
    ];
    return {
        exitCode: interrupted ? exitCodes.interrupted : exitCodes.success,
        text: command.quiet ? "" : summary.join("\n"),
        document: {
            ...document,
            ...(quads === null ? {} : { quads: quadDocument(quads) }),
            ...(report === null ? {} : { report }),
            files,
        },
    };
}

function reportText({ overall }: QualityReport): string {
    const { evenLength, length, turning, leastQuotient, meanQuotient, largestStretch } = overall;
    return (
        `paths ${length.toPrecision(8)} long, ${evenLength.toPrecision(8)} before smoothing, ` +
        `turning ${turning.toFixed(1)} degrees in all; isoperimetric quotient of the patches ` +
        `${leastQuotient.toFixed(3)} at least, ${meanQuotient.toFixed(3)} on average; stretch of ` +
        `their maps ${largestStretch?.toFixed(2) ?? "unknown"} at most`
    );
}

function quadDocument({ faces, subdivided, loops, statistics }: QuadMesh) {
    return { count: faces.length, subdivided, loops: Array.from(loops), ...statistics };
}

function quadText({ faces, subdivided, statistics }: QuadMesh): string {
    const { flipped, leastJacobian, meanJacobian, leastAngle, largestAngle } = statistics;
    return (
        `${String(faces.length)} quads${subdivided ? " (layout faces subdivided)" : ""}, ` +
        `${String(flipped)} flipped; scaled Jacobian ${leastJacobian.toFixed(3)} at least, ` +
        `${meanJacobian.toFixed(3)} on average; angles ${leastAngle.toFixed(1)} to ` +
        `${largestAngle.toFixed(1)} degrees`
    );
}

function exitCodeWithout(result: EmbedResult, command: EmbedCommand): number {
    switch (result.status) {
        case "infeasible":
            return exitCodes.infeasible;
        case "memoryLimit":
            // A limit of the user's is a limit; without one, memory really ran out.
            if (command.solve.memoryLimit === undefined) {
                throw new LayoutError("memoryLimit", result.message ?? "memory ran out.");
            }
            return exitCodes.noneFound;
        default:
            return exitCodes.noneFound;
    }
}

function failureText(result: EmbedResult): string {
    const reason = result.message ?? "";
    return result.status === "infeasible"
        ? "no embedding exists"
        : `no embedding found (${result.status}) ${reason}`.trimEnd();
}

function summaryText(document: EmbeddingDocument, files: string[]): string {
    const number = (value: number | null) => (value === null ? "unknown" : value.toPrecision(8));
    const gap = document.gap === null ? "unknown" : `${(100 * document.gap).toPrecision(3)} %`;
    const scope =
        document.boundScope === "embeddings" ? "of all embeddings" : "of all insertion sequences";
    const length = document.edges.reduce((sum, edge) => sum + edge.length, 0);
    const lines = [
        `${String(document.edges.length)} edges embedded (${document.status}) in ` +
            `${document.seconds.toFixed(2)} s`,
        `cost ${number(document.cost)}, at least ${number(document.lowerBound)} ${scope}, ` +
            `gap ${gap} (all in the path-graph metric)`,
        `length of the chains on the surface ${number(length)} (${document.shape}), ` +
            `smallest angle ${number(document.quality?.smallestAngle ?? null)} degrees`,
    ];
    if (files.length > 0) {
        lines.push(`written: ${files.join(", ")}`);
    }
    return lines.join("\n");
}
