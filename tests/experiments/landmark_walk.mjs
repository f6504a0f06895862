// A landmark that moves along the target's edges, and paths that follow it: every weak path stays in
// the homotopy class that the motion carries it into.
//
// A step moves the landmark from vertex p to its neighbour q. Paths that end at p are prolonged by the
// edge. Whatever of a path touches the edge before it is pushed ahead, around q: a stretch through the
// edge's midpoint or q becomes the way around q that avoids the midpoint.

const key = (point) => [...point].sort((a, b) => a - b).join(" ");

/** Which vertices lie around each vertex of a closed triangle mesh, in order. */
export function rings(vertexCount, corners) {
    const next = Array.from({ length: vertexCount }, () => new Map());
    for (let t = 0; t < corners.length; t += 3) {
        for (let k = 0; k < 3; ++k) {
            const [a, b, c] = [0, 1, 2].map((i) => corners[t + ((k + i) % 3)]);
            next[a].set(b, c);
        }
    }
    return next.map((map) => {
        const first = map.keys().next().value;
        const ring = [first];
        for (let v = map.get(first); v !== first; v = map.get(v)) {
            ring.push(v);
        }
        return ring;
    });
}

/** The points of the path graph around vertex q, beginning after the midpoint of its edge to p. */
function pointsAround(q, p, ring) {
    const start = ring.indexOf(p);
    const points = [];
    for (let i = 0; i < ring.length; ++i) {
        const a = ring[(start + i) % ring.length];
        const b = ring[(start + i + 1) % ring.length];
        if (i > 0) {
            points.push([q, a]);
        }
        points.push([q, a, b]);
    }
    return points;
}

/** A path without steps that are taken back at once. */
function reduced(path) {
    const result = [];
    for (const point of path) {
        if (result.length > 1 && key(result.at(-2)) === key(point)) {
            result.pop();
        } else if (result.length === 0 || key(result.at(-1)) !== key(point)) {
            result.push(point);
        }
    }
    return result;
}

/** The path after the landmark at p has moved to q, where `path` does not end at p. */
function pushed(path, p, q, ring) {
    const blocked = new Set([key([q]), key([p, q])]);
    const around = pointsAround(q, p, ring);
    const places = new Map(around.map((point, i) => [key(point), i]));
    const result = [];
    for (let i = 0; i < path.length; ++i) {
        if (!blocked.has(key(path[i]))) {
            result.push(path[i]);
            continue;
        }
        let end = i;
        while (end < path.length && blocked.has(key(path[end]))) {
            ++end;
        }
        // From the point before the stretch to the one after it, both around q.
        const from = places.get(key(path[i - 1]));
        const to = places.get(key(path[end]));
        if (from === undefined || to === undefined) {
            return null;
        }
        const step = from <= to ? 1 : -1;
        for (let at = from; at !== to; at += step) {
            result.push(around[at]);
        }
        i = end - 1;
    }
    return reduced(result);
}

/** With p as its first point. */
function prolonged(path, p, q, ring) {
    // The path's beginning may run along the edge; that stretch is taken back. Later ones are pushed.
    const whole = reduced([[q], [p, q], ...path]);
    const begins = key(whole[1]) === key([p, q]) ? 2 : 1;
    const rest = pushed(whole.slice(begins), p, q, ring);
    return rest === null ? null : reduced([...whole.slice(0, begins), ...rest]);
}

/**
 * All paths after the landmark at vertex p has moved to q; null where q is a landmark, or the step
 * would turn a path at its other end.
 */
export function afterStep(paths, p, q, ring) {
    const result = [];
    for (const path of paths) {
        const [first, last] = [path[0], path.at(-1)].map((point) => point[0]);
        if (first === q || last === q) {
            return null;
        }
        let moved;
        if (first === p) {
            moved = prolonged(path, p, q, ring);
        } else if (last === p) {
            moved = prolonged([...path].reverse(), p, q, ring)?.reverse();
        } else {
            moved = pushed(path, p, q, ring);
        }
        if (!moved) {
            return null;
        }
        result.push(moved);
    }
    return result;
}
