// Rules for single paths of the embedding, as people ask for them: routes that stay, and routes that
// are not taken again.
import type { EmbeddedEdge, LayoutInfo, PathConstraint } from "layout-embedding";
import { formatLength } from "./describe.js";
import { landmarkLabel, landmarkOn, type Landmarks } from "./landmarks.js";

export interface RouteRule extends Readonly<PathConstraint> {
    /** Of the path, as in EmbeddedEdge. */
    readonly edgeCost: number;
    /** What the embedding cost before the rule; null where that was another problem. */
    readonly costBefore: number | null;
}

export const ruleFor = (
    rule: RouteRule["rule"],
    { id, weakPath, cost }: EmbeddedEdge,
    costBefore: number | null,
): RouteRule => ({ rule, edge: id, path: weakPath, edgeCost: cost, costBefore });

export const keptRule = (routes: readonly RouteRule[], edge: number): RouteRule | null =>
    routes.find((one) => one.rule === "keep" && one.edge === edge) ?? null;

/** The latest rule of an edge that has a price. */
export const pricedRule = (routes: readonly RouteRule[], edge: number): RouteRule | null =>
    routes.findLast((one) => one.edge === edge && one.costBefore !== null) ?? null;

/** Whether the path of a rule leads from landmark to landmark of its edge, and past all others. */
export function fits(
    { edge, path }: PathConstraint,
    layout: LayoutInfo,
    landmarks: Landmarks,
): boolean {
    const ends = layout.edges.subarray(2 * edge, 2 * edge + 2);
    const vertexAt = (place: number) => {
        const point = path.at(place);
        return point?.length === 1 ? point[0]! : null;
    };
    return (
        ends.length === 2 &&
        path.length > 1 &&
        vertexAt(0) === landmarks.places[ends[0]!] &&
        vertexAt(-1) === landmarks.places[ends[1]!] &&
        path.slice(1, -1).every(([v, w]) => w !== undefined || landmarkOn(landmarks, v!) === null)
    );
}

/** A rule in words, after the words for its edge. */
export const ruleWords = ({ rule, edgeCost }: RouteRule): string =>
    rule === "keep"
        ? `keeps its route (cost ${formatLength(edgeCost)}).`
        : `may not take the route of cost ${formatLength(edgeCost)}.`;

/** The labels of the two landmarks that an edge runs between. */
export const endsOf = (
    edge: number,
    layout: LayoutInfo,
    landmarks: Landmarks | null,
): readonly string[] =>
    [...layout.edges.subarray(2 * edge, 2 * edge + 2)].map((v) => landmarkLabel(landmarks, v));

/** Says which rules ended, and why. */
export function droppedWords(dropped: readonly RouteRule[], why: string): string {
    const edges = [...new Set(dropped.map(({ edge }) => edge))].sort((a, b) => a - b);
    const what =
        edges.length === 1 ? "The rule for the route of edge" : "Rules for routes of edges";
    return `${what} ${edges.join(", ")} ended: ${why}.`;
}
