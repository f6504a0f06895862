// Weak paths: walks in the path graph, as the package lists them (WeakPoint in wasm/src/types/solve.ts).

/** Constraints that keep every layout edge in the class of its path. */
export function keptPaths(paths) {
    return paths.map((path, edge) => ({ rule: "keep", edge, path }));
}
