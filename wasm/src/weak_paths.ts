// Paths in the path graph as the core takes them.
import type { WeakPoint } from "./types.js";

const none = 0xffff_ffff;

/** Lists one after the other, and where each begins, counted in items of `itemSize` numbers. */
export function flattened(lists: Uint32Array[], itemSize: number) {
    const offsets = Uint32Array.from({ length: lists.length + 1 });
    lists.forEach((list, i) => {
        offsets[i + 1] = (offsets[i] ?? 0) + list.length / itemSize;
    });
    const items = new Uint32Array((offsets[lists.length] ?? 0) * itemSize);
    lists.forEach((list, i) => {
        items.set(list, (offsets[i] ?? 0) * itemSize);
    });
    return { items, offsets };
}

/** Three numbers per point. `refuse` makes the error for a point that is none. */
export function flattenedWeakPaths(
    paths: readonly (readonly WeakPoint[])[],
    refuse: (place: number) => Error,
) {
    return flattened(
        paths.map((path, place) =>
            Uint32Array.from(
                path.flatMap((point) => {
                    if (
                        point.length < 1 ||
                        point.length > 3 ||
                        !point.every((vertex) => vertex === vertex >>> 0 && vertex !== none)
                    ) {
                        throw refuse(place);
                    }
                    return [point[0] ?? none, point[1] ?? none, point[2] ?? none];
                }),
            ),
        ),
        3,
    );
}
