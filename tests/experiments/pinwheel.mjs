// Three edges in the plane, without common vertices, for which no insertion sequence is optimal: the
// kind of example that is known for general graphs (paper, Sec. 6). Computed on rings of points around
// the vertices, which paths may run through; paths keep their distance from each other and from the
// vertices by the rings' radii.

const rings = [0.1, 0.2, 0.3];
const ringSize = 16;
const far = 4;
const near = 0.22;

/** The edges: [far end, near end], each near end just beyond the next edge. */
const edges = [0, 1, 2].map((i) => {
    const angle = (2 * Math.PI * i) / 3;
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const inradius = 0.5;
    const along = (t) => [t * c - inradius * s, t * s + inradius * c];
    return [along(-far), along(Math.sqrt(3) * inradius + near)];
});

const distance = (p, q) => Math.hypot(q[0] - p[0], q[1] - p[1]);

function lengthOf(path) {
    return path.slice(1).reduce((sum, p, i) => sum + distance(path[i], p), 0);
}

/** Whether two segments have a point in common. */
function meet(a, b, c, d) {
    const side = (p, q, r) =>
        Math.sign(
            Number(((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])).toFixed(12)),
        );
    return side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0;
}

const nodes = edges.flat().flatMap(([x, y]) =>
    rings.flatMap((radius) =>
        Array.from({ length: ringSize }, (_, k) => {
            const angle = (2 * Math.PI * k) / ringSize;
            return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
        }),
    ),
);

/** The shortest path of an edge that meets none of the paths (Dijkstra). */
function shortestPath(edge, paths) {
    const obstacles = paths.flatMap((path) => path.slice(1).map((p, i) => [path[i], p]));
    const points = [edges[edge][0], edges[edge][1], ...nodes];
    const isFree = (p, q) => obstacles.every(([c, d]) => !meet(p, q, c, d));
    const lengths = points.map((_, i) => (i === 0 ? 0 : Infinity));
    const before = points.map(() => -1);
    const done = new Set();
    for (;;) {
        let best = -1;
        lengths.forEach((length, i) => {
            if (!done.has(i) && length < (lengths[best] ?? Infinity)) {
                best = i;
            }
        });
        if (best === 1) {
            break;
        }
        if (best < 0) {
            return null;
        }
        done.add(best);
        points.forEach((q, i) => {
            const through = lengths[best] + distance(points[best], q);
            if (through < lengths[i] && isFree(points[best], q)) {
                lengths[i] = through;
                before[i] = best;
            }
        });
    }
    const path = [];
    for (let i = 1; i >= 0; i = before[i]) {
        path.unshift(points[i]);
    }
    return path;
}

/** The best of the six insertion sequences: paths per edge. */
function bestSequence() {
    const orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]]; // prettier-ignore
    let best = null;
    for (const order of orders) {
        const paths = [];
        for (const edge of order) {
            paths[edge] = shortestPath(edge, Object.values(paths));
        }
        const total = paths.reduce((sum, path) => sum + lengthOf(path), 0);
        if (best === null || total < best.total) {
            best = { paths, total };
        }
    }
    return best;
}

/** Each edge around the near end of the one before, then each as short as the others allow. */
function pinwheelPaths() {
    const paths = edges.map(([start, end], i) => {
        const [from, to] = edges[(i + 2) % 3];
        const step = 0.15 / distance(from, to);
        const around = to.map((x, axis) => x + step * (x - from[axis]));
        return [start, around, end];
    });
    for (let round = 0; round < 3; ++round) {
        edges.forEach((_, i) => {
            paths[i] = shortestPath(
                i,
                paths.filter((_path, k) => k !== i),
            );
        });
    }
    return { paths, total: paths.reduce((sum, path) => sum + lengthOf(path), 0) };
}

const strokes = ["#0072b2", "#d55e00", "#009e73"];

function drawing(paths, x, caption) {
    const at = ([px, py]) => `${(x + 26 * px).toFixed(1)} ${(130 - 26 * py).toFixed(1)}`;
    const lines = paths.map(
        (path, i) =>
            `<path d="M${path.map(at).join("L")}" fill="none" stroke="${strokes[i]}" stroke-width="2.2"/>`,
    );
    const dots = edges.flatMap((ends, i) =>
        ends.map((p) => {
            const [cx, cy] = at(p).split(" ");
            return `<circle cx="${cx}" cy="${cy}" r="4" fill="${strokes[i]}"/>`;
        }),
    );
    return `${lines.join("")}${dots.join("")}<text x="${x}" y="262" text-anchor="middle">${caption}</text>`;
}

/** { optimum, sequence, straight: total lengths, svg }. */
export function pinwheel() {
    const straight = { paths: edges, total: edges.reduce((sum, path) => sum + lengthOf(path), 0) };
    const optimum = pinwheelPaths();
    const sequence = bestSequence();
    const svg = `<div class="wide"><svg class="plot" viewBox="0 0 780 272" style="max-width:780px" role="img" aria-label="Three edges in the plane: alone, as a pinwheel, and as the best insertion sequence">${[
        drawing(straight.paths, 130, `alone: ${straight.total.toFixed(2)}`),
        drawing(optimum.paths, 390, `pinwheel: ${optimum.total.toFixed(2)}`),
        drawing(sequence.paths, 650, `best insertion sequence: ${sequence.total.toFixed(2)}`),
    ].join("")}</svg></div>`;
    return {
        straight: straight.total,
        optimum: optimum.total,
        sequence: sequence.total,
        svg,
    };
}
