// The candidate paths of a solved problem, read out of the core.
import type { Core, Handle } from "./core.js";
import { drawnPaths } from "./drawn_paths.js";
import type { CandidatePaths } from "./types.js";

/** Finds the candidate paths in a job's path graph, and their conflicts. */
export function candidatePaths(core: Core, job: Handle): CandidatePaths {
    core.call("boundary_candidates_find", job);
    const lengths = core.viewedDoubles();
    core.call("boundary_candidates_pairs");
    const pairs = core.viewedIds();
    core.call("boundary_candidates_triples");
    return { lengths, pairs, triples: core.viewedIds(), paths: drawnPaths(core) };
}
