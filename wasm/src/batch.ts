// One layout in many targets: embeddings, quad meshes of the same connectivity, and maps from one
// of the targets to all others. What goes wrong with one member does not stop the rest.
import { asLayoutError, javaScriptError } from "./errors.js";
import type {
    BatchMember,
    BatchOptions,
    BatchProducts,
    BatchRow,
    EmbeddingSession,
    MeshInput,
    QuadOptions,
} from "./types.js";

/** Runs a batch in a fresh session; one row per member, in their order. */
export async function batchIn(
    session: EmbeddingSession,
    layout: MeshInput,
    members: readonly BatchMember[],
    options: BatchOptions,
): Promise<BatchRow[]> {
    await session.loadLayout(layout, { repair: options.repair === true });
    const { reference = null } = options;
    if (reference !== null && !members.some(({ name }) => name === reference)) {
        throw javaScriptError(
            "invalidInput",
            `there is no member ${reference} to be the reference`,
        );
    }
    const rows = new Map<string, BatchRow>();
    // The reference comes first; all others get its numbers of segments.
    const order = [...members].sort(
        (a, b) => Number(b.name === reference) - Number(a.name === reference),
    );
    let segments: Uint32Array | null = null;
    const isAborted = () => options.signal?.aborted === true;
    for (const member of order) {
        if (isAborted()) {
            break;
        }
        const isReference = segments === null && (reference === null || member.name === reference);
        const known = options.known?.(member.name) ?? null;
        // The reference is needed for all that is still to be done.
        const pending = order.some(({ name }) => (options.known?.(name) ?? null) === null);
        if (known !== null && !(isReference && pending)) {
            rows.set(member.name, known);
            continue;
        }
        const quadOptions: QuadOptions =
            segments === null ? { ...options.quads } : { ...options.quads, segmentsAs: segments };
        const { row, products } = await runMember(
            session,
            member,
            options,
            quadOptions,
            isReference ? "reference" : segments === null ? "alone" : "target",
        );
        if (isAborted()) {
            break;
        }
        if (isReference && products !== null) {
            segments = products.quads.segments;
            row.isReference = true;
        }
        rows.set(member.name, row);
        await options.onMember?.(row, products);
    }
    return members.flatMap(({ name }) => rows.get(name) ?? []);
}

async function runMember(
    session: EmbeddingSession,
    member: BatchMember,
    options: BatchOptions,
    quadOptions: QuadOptions,
    role: "reference" | "target" | "alone",
): Promise<{ row: BatchRow; products: BatchProducts | null }> {
    const row: BatchRow = { name: member.name, isReference: false, error: null };
    try {
        const { target, landmarks } = await member.load();
        const { signal } = options;
        const aborting = signal ? { signal } : {};
        const { vertexCount } = await session.loadTarget(target, {
            repair: options.repair === true,
            ...aborting,
        });
        row.vertexCount = vertexCount;
        await session.setLandmarks(landmarks);
        const result = await session.solve({ ...options.solve, ...aborting });
        row.status = result.status;
        if (result.refined === null) {
            throw javaScriptError(
                "noEmbedding",
                `the layout was not embedded in ${member.name} (${result.status})`,
            );
        }
        row.cost = result.cost;
        row.lowerBound = result.lowerBound;
        row.gap = result.gap;
        row.length = result.edges.reduce((sum, edge) => sum + edge.length, 0);
        row.seconds = result.cpuSeconds;
        const files = await session.exportFiles();
        const quads = await session.quads({ ...quadOptions, ...aborting });
        row.quads = quads.faces.length;
        row.flippedQuads = quads.statistics.flipped;
        row.leastJacobian = quads.statistics.leastJacobian;
        row.meanJacobian = quads.statistics.meanJacobian;
        if (role === "reference") {
            await session.setReference();
        }
        const map =
            role === "target"
                ? await session.mapFromReference({ ...options.map, ...aborting })
                : null;
        if (map !== null) {
            row.energy = map.distortion.meanEnergy;
            row.firstEnergy = map.firstDistortion.meanEnergy;
            row.conformal = map.distortion.meanConformal;
            row.area = map.distortion.meanArea;
        }
        return { row, products: { result, files, quads, map } };
    } catch (reason) {
        const { code, message } = asLayoutError(reason);
        row.error = { code, message };
        return { row, products: null };
    }
}

const columns = [
    "name",
    "isReference",
    "status",
    "vertexCount",
    "cost",
    "lowerBound",
    "gap",
    "length",
    "seconds",
    "quads",
    "flippedQuads",
    "leastJacobian",
    "meanJacobian",
    "firstEnergy",
    "energy",
    "conformal",
    "area",
] as const satisfies readonly (keyof BatchRow)[];

/** The rows as comma-separated values, with a line of headings. */
export function batchTable(rows: readonly BatchRow[]): string {
    const cell = (value: string | number | boolean | undefined) => {
        const text = value === undefined ? "" : String(value);
        return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
    };
    return [
        [...columns, "errorCode", "errorMessage"].join(","),
        ...rows.map((row) =>
            [...columns.map((column) => row[column]), row.error?.code, row.error?.message]
                .map(cell)
                .join(","),
        ),
        "",
    ].join("\n");
}
