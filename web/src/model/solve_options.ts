// Settings as the package is asked for them.
import type { SolveOptions } from "layout-embedding";
import type { RouteRule } from "./routes.js";
import type { PathSettings, SolveSettings } from "./state.js";

/** Whether only the exact method can do what is asked for. */
export const needsExact = (
    { boundaryEdges }: PathSettings,
    routes: readonly RouteRule[],
): boolean => boundaryEdges === "follow" || routes.length > 0;

/** What paths cost, and where they have to run. */
export const pathOptions = ({
    featureDiscount,
    boundaryEdges,
}: PathSettings): Pick<SolveOptions, "metric" | "boundaryEdges"> => ({
    metric: { featureDiscount },
    boundaryEdges,
});

/** A search as it was set, with rules for single routes; with the exact method where it has to be. */
export function solveOptions(
    settings: SolveSettings,
    routes: readonly RouteRule[] = [],
): SolveOptions {
    const { algorithm, gap, seed, shape, timeLimit, workLimit } = settings;
    return {
        gap,
        seed,
        shape,
        ...pathOptions(settings),
        ...(algorithm !== null && !needsExact(settings, routes) && { algorithm }),
        ...(timeLimit !== null && { timeLimit }),
        ...(workLimit !== null && { workLimit }),
        constraints: routes.map(({ rule, edge, path }) => ({ rule, edge, path })),
    };
}

/** For a heuristic on the same problem; only the exact method knows edges that follow the boundary. */
export const heuristicOptions = ({
    seed,
    shape,
    featureDiscount,
}: SolveSettings): Pick<SolveOptions, "seed" | "shape" | "metric"> => ({
    seed,
    shape,
    metric: { featureDiscount },
});
