// What embedding.json says in numbers, compared with what is there; the checker looks at the
// embedding itself.
import { chainLength } from "../job.js";
import type { LayoutInfo, Violation, WeakPoint } from "../types.js";
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
    target: Float64Array,
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
    const cost = document.edges.reduce((sum, edge) => sum + weakLength(target, edge.weakPath), 0);
    const steps = document.edges.reduce((sum, edge) => sum + edge.weakPath.length, 0);
    const tolerance = steps * perturbation * diagonal(target) + rounding * cost;
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

/** The length of a weak path between the centroids of its points' target vertices. */
function weakLength(target: Float64Array, path: WeakPoint[]): number {
    const points = path.flatMap((point) =>
        [0, 1, 2].map(
            (axis) =>
                point.reduce((sum, vertex) => sum + (target[3 * vertex + axis] ?? NaN), 0) /
                point.length,
        ),
    );
    return chainLength(
        points,
        path.map((_, place) => place),
    );
}
