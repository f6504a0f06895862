// The data that go in and out of the package, the same in a thread of its own (client.ts) and in
// the caller's (session.ts). Units are the target's; all ids are 0-based.
export type * from "./types/input.js";
export type * from "./types/solve.js";
export type * from "./types/results.js";
export type * from "./types/quads.js";
export type * from "./types/maps.js";
export type * from "./types/session.js";
export type * from "./types/problems.js";
export type * from "./types/batch.js";
