// What embedding.json says in numbers, compared with what is there; the checker looks at the
// embedding itself.
import { chainLength } from "../job.js";
import type { LayoutInfo, TargetInfo, Violation, WeakPoint } from "../types.js";
import type { WrittenEmbedding } from "./read_embedding.js";

/** Sums of the same numbers in another order differ by less. */
const rounding = 1e-9;
/**
 * Costs contain the perturbation that makes shortest paths unique: per step of a path, at most this
 * share of the target's diagonal (core/surface/path_graph.cc).
 */
const perturbation = 2 ** -22;

export function checkNumbers(
    { document, refined, lines }: WrittenEmbedding,
    layout: LayoutInfo,
    target: TargetInfo,
): Violation[] {
    const violations: Violation[] = [];
    const refuse = (code: string, message: string) => violations.push({ code, message });
    const edgeCount = layout.edges.length / 2;
    if (document.edges.length !== edgeCount || lines.length !== edgeCount) {
        refuse("edgesDiffer", `the layout has ${String(edgeCount)} edges, the embedding has not.`);
    }
    for (const [place, edge] of document.edges.entries()) {
        const name = `edge ${String(place)}`;
        const [start, end] = edge.layoutEdge;
        if (
            edge.id !== place ||
            start !== layout.edges[2 * place] ||
            end !== layout.edges[2 * place + 1]
        ) {
            refuse("edgesDiffer", `${name} is not the layout's edge of that number.`);
        }
        const line = lines[place];
        if (line?.length !== edge.chain.length || line.some((id, i) => id !== edge.chain[i])) {
            refuse(
                "linesDiffer",
                `${name} is another chain in refined.obj than in embedding.json.`,
            );
        }
        if (!near(edge.length, chainLength(refined.positions, edge.chain), rounding)) {
            refuse("lengthWrong", `${name} says it is ${String(edge.length)} long, and is not.`);
        }
    }
    const { vertexCosts, edgeWeights } = document.metric;
    const price = pricing(target, document.metric);
    const weight = weighing(edgeWeights);
    const cost = document.edges.reduce(
        (sum, { id, weakPath }) => sum + weight(id) * price(weakPath),
        0,
    );
    const steps = document.edges.reduce(
        (sum, { id, weakPath }) => sum + weight(id) * weakPath.length,
        0,
    );
    const dearest = Math.max(1, ...(vertexCosts ?? []));
    const tolerance = steps * perturbation * dearest * diagonal(target.positions) + rounding * cost;
    if (document.cost === null || !(Math.abs(document.cost - cost) <= tolerance)) {
        refuse("costWrong", `the weak paths add up to ${String(cost)}, not to the cost.`);
        return violations;
    }
    const { lowerBound, gap } = document;
    if (lowerBound === null || !(lowerBound >= 0 && lowerBound <= document.cost * (1 + rounding))) {
        refuse("boundWrong", "the lower bound is no number from 0 to the cost.");
    } else if (
        gap === null ||
        Math.abs(gap - (document.cost - lowerBound) / document.cost) > rounding
    ) {
        refuse("gapWrong", "the gap is not (cost - lowerBound) / cost.");
    }
    return violations;
}

function near(a: number, b: number, tolerance: number): boolean {
    return Math.abs(a - b) <= tolerance * Math.max(Math.abs(a), Math.abs(b));
}

/** Of the bounding box. */
function diagonal(positions: Float64Array): number {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    positions.forEach((coordinate, i) => {
        low[i % 3] = Math.min(low[i % 3] ?? Infinity, coordinate);
        high[i % 3] = Math.max(high[i % 3] ?? -Infinity, coordinate);
    });
    return Math.hypot(...high.map((coordinate, axis) => coordinate - (low[axis] ?? 0)));
}

/** Weights as the core rounds them, to parts of the largest (core/layout/edge_weights.hh). */
function weighing(weights: number[] | null): (edge: number) => number {
    if (weights === null) {
        return () => 1;
    }
    const part = Math.max(...weights) / 1024;
    return (edge) => Math.max(1, Math.round((weights[edge] ?? NaN) / part)) * part;
}

/**
 * What a weak path costs between the centroids of its points' target vertices. That is worked out
 * here from the mesh, not by the code that the search has.
 */
function pricing(
    { positions, corners }: TargetInfo,
    { vertexCosts, featureDiscount }: WrittenEmbedding["document"]["metric"],
): (path: WeakPoint[]) => number {
    const at = (vertex: number, axis: number) => positions[3 * vertex + axis] ?? NaN;
    const mean = (point: WeakPoint, of: (vertex: number) => number) =>
        point.reduce((sum, vertex) => sum + of(vertex), 0) / point.length;
    const place = (point: WeakPoint) =>
        [0, 1, 2].map((axis) => mean(point, (vertex) => at(vertex, axis)));
    const cost = (point: WeakPoint) =>
        vertexCosts === null ? 1 : mean(point, (vertex) => vertexCosts[vertex] ?? NaN);
    const discounts =
        featureDiscount > 0
            ? sharpEdges(positions, corners, featureDiscount)
            : new Map<string, number>();
    const along = (a: WeakPoint, b: WeakPoint) => {
        const [edge, other] = a.length === 2 ? [a, b] : [b, a];
        return edge.length === 2 && other.length === 1
            ? (discounts.get([...edge].sort((v, w) => v - w).join(" ")) ?? 1)
            : 1;
    };
    return (path) => {
        let sum = 0;
        for (const [i, b] of path.entries()) {
            const a = path[i - 1];
            if (a !== undefined) {
                const from = place(a);
                const length = Math.hypot(...place(b).map((x, axis) => x - (from[axis] ?? NaN)));
                sum += ((length * (cost(a) + cost(b))) / 2) * along(a, b);
            }
        }
        return sum;
    };
}

/** Per edge between two faces, "v w" with v < w: the share of its length that counts. */
function sharpEdges(
    positions: Float64Array,
    corners: Uint32Array,
    discount: number,
): Map<string, number> {
    const normals = new Map<string, number[][]>();
    for (let i = 0; i < corners.length; i += 3) {
        const face = [...corners.subarray(i, i + 3)];
        const [a, b, c] = face.map((vertex) => [
            ...positions.subarray(3 * vertex, 3 * vertex + 3),
        ]) as [number[], number[], number[]];
        const u = b.map((x, axis) => x - (a[axis] ?? NaN)) as [number, number, number];
        const v = c.map((x, axis) => x - (a[axis] ?? NaN)) as [number, number, number];
        const normal = [
            u[1] * v[2] - u[2] * v[1],
            u[2] * v[0] - u[0] * v[2],
            u[0] * v[1] - u[1] * v[0],
        ];
        for (const [k, vertex] of face.entries()) {
            const next = face[(k + 1) % 3] ?? 0;
            const key = `${String(Math.min(vertex, next))} ${String(Math.max(vertex, next))}`;
            normals.set(key, [...(normals.get(key) ?? []), normal]);
        }
    }
    const shares = new Map<string, number>();
    const begins = Math.cos(Math.PI / 9);
    const full = Math.cos(Math.PI / 3);
    for (const [key, [m, n]] of normals) {
        if (m !== undefined && n !== undefined) {
            const dot = m.reduce((sum, x, axis) => sum + x * (n[axis] ?? NaN), 0);
            const cosine = dot / (Math.hypot(...m) * Math.hypot(...n));
            const sharpness = Math.min(1, Math.max(0, (begins - cosine) / (begins - full)));
            shares.set(key, 1 - discount * sharpness);
        }
    }
    return shares;
}
