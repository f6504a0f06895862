// What the package's options are called, for whoever offers a choice. In the order of the core's
// enumerations (core/apps/embed_job.hh).
import type { Algorithm, PathShape } from "./types.js";

/** Every algorithm there is. */
export const algorithmNames: readonly Algorithm[] = [
    "greedy",
    "praun",
    "kraevoy",
    "schreiner",
    "branch-and-bound",
    "exact",
];

/** Every path shape there is. */
export const pathShapeNames: readonly PathShape[] = ["even", "short", "fair"];
