// Meshes and landmarks that the benchmark makes itself. Additions, multiplications, divisions and
// square roots alone, so that every machine makes the same files.
import { readFileSync, writeFileSync } from "node:fs";
import { cross, dot, minus, normalized, times } from "./vectors.mjs";

/** SplitMix64 (Steele, Lea, Flood 2014), as in core/base/random.hh. */
export class Random {
    constructor(seed) {
        this.state = BigInt(seed);
    }
    /** A uniform number in [0, 1) with 53 random bits. */
    unit() {
        const wrap = (x) => BigInt.asUintN(64, x);
        this.state = wrap(this.state + 0x9e3779b97f4a7c15n);
        let x = this.state;
        x = wrap((x ^ (x >> 30n)) * 0xbf58476d1ce4e5b9n);
        x = wrap((x ^ (x >> 27n)) * 0x94d049bb133111ebn);
        return Number((x ^ (x >> 31n)) >> 11n) / 2 ** 53;
    }
    /** A point on the unit sphere. */
    direction() {
        for (;;) {
            const p = [0, 0, 0].map(() => 2 * this.unit() - 1);
            const square = dot(p, p);
            if (square > 0.01 && square <= 1) {
                return normalized(p);
            }
        }
    }
}

const golden = (1 + Math.sqrt(5)) / 2;
const icosahedron = {
    positions: [
        [-1, golden, 0],
        [1, golden, 0],
        [-1, -golden, 0],
        [1, -golden, 0],
        [0, -1, golden],
        [0, 1, golden],
        [0, -1, -golden],
        [0, 1, -golden],
        [golden, 0, -1],
        [golden, 0, 1],
        [-golden, 0, -1],
        [-golden, 0, 1],
    ],
    faces: [
        ...[0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4, 11, 10, 2],
        ...[10, 7, 6, 7, 1, 8, 3, 9, 4, 3, 4, 2, 3, 2, 6, 3, 6, 8, 3, 8, 9, 4, 9, 5, 2, 4, 11],
        ...[6, 2, 10, 8, 6, 7, 9, 8, 1],
    ],
};

/** The unit sphere as an icosahedron with `n` edges for each of its own: 20 n^2 triangles. */
export function sphere(n) {
    const positions = icosahedron.positions.map(normalized);
    const ids = new Map();
    const faces = [];
    for (let f = 0; f < 60; f += 3) {
        const corners = icosahedron.faces.slice(f, f + 3);
        // The point with the weights i, j and n - i - j; those on edges belong to two faces.
        const id = (i, j) => {
            const weights = corners
                .map((corner, c) => [corner, [i, j, n - i - j][c]])
                .filter(([, weight]) => weight > 0)
                .sort(([a], [b]) => a - b);
            if (weights.length === 1) {
                return weights[0][0];
            }
            const key = weights.length === 3 ? `${f} ${i} ${j}` : weights.join();
            let vertex = ids.get(key);
            if (vertex === undefined) {
                const p = [0, 0, 0];
                for (const [corner, weight] of weights) {
                    for (const axis of [0, 1, 2]) {
                        p[axis] += weight * icosahedron.positions[corner][axis];
                    }
                }
                vertex = positions.length;
                positions.push(normalized(p));
                ids.set(key, vertex);
            }
            return vertex;
        };
        for (let i = 0; i < n; ++i) {
            for (let j = 0; i + j < n; ++j) {
                faces.push([id(i, j), id(i + 1, j), id(i, j + 1)]);
                if (i + j + 1 < n) {
                    faces.push([id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)]);
                }
            }
        }
    }
    return { positions, faces };
}

/** The unit sphere's points moved in or out to make smooth bumps and dents. */
export function withBumps(positions, seed) {
    const random = new Random(seed);
    const bumps = Array.from({ length: 12 }, () => {
        const direction = random.direction();
        const height = 0.9 * random.unit() - 0.3;
        return { direction, height, sharpness: 3 + 12 * random.unit() };
    });
    return positions.map((p) => {
        let radius = 1;
        for (const { direction, height, sharpness } of bumps) {
            radius += height / (1 + sharpness * (1 - dot(direction, p)));
        }
        return times(Math.max(radius, 0.2), p);
    });
}

export function randomDirections(count, seed) {
    const random = new Random(seed);
    return Array.from({ length: count }, () => random.direction());
}

/** The convex hull of points, all of which are corners of it: triangles, seen from outside. */
export function convexHull(points) {
    const isAbove = ([a, b, c], point) => {
        const normal = cross(minus(points[b], points[a]), minus(points[c], points[a]));
        return dot(normal, minus(points[point], points[a])) > 0;
    };
    let faces = isAbove([0, 1, 2], 3)
        ? [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] // prettier-ignore
        : [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]; // prettier-ignore
    for (let point = 4; point < points.length; ++point) {
        const seen = faces.filter((face) => isAbove(face, point));
        const sides = seen.flatMap(([a, b, c]) => [
            [a, b],
            [b, c],
            [c, a],
        ]);
        const names = new Set(sides.map(([a, b]) => `${a} ${b}`));
        const horizon = sides.filter(([a, b]) => !names.has(`${b} ${a}`));
        faces = faces.filter((face) => !seen.includes(face));
        faces.push(...horizon.map(([a, b]) => [a, b, point]));
    }
    return faces;
}

/** Per direction, in turn, the vertex in this direction that is not taken yet. */
export function nearestVertices(positions, directions) {
    const taken = new Set();
    return directions.map((direction) => {
        let best = -1;
        let largest = -2;
        positions.forEach((p, vertex) => {
            const cosine = dot(p, direction);
            if (cosine > largest && !taken.has(vertex)) {
                best = vertex;
                largest = cosine;
            }
        });
        taken.add(best);
        return best;
    });
}

/** Directions turned away by about `distance` at random. */
export function displaced(directions, distance, seed) {
    const random = new Random(seed);
    return directions.map((p) => {
        const q = random.direction();
        return normalized(p.map((x, axis) => x + distance * q[axis]));
    });
}

export function writeObj(file, { positions, faces }) {
    const lines = positions.map((p) => `v ${p.join(" ")}`);
    for (const face of faces) {
        lines.push(`f ${face.map((v) => v + 1).join(" ")}`);
    }
    writeFileSync(file, `${lines.join("\n")}\n`);
}

export function writeLandmarks(file, landmarks) {
    writeFileSync(file, `${landmarks.join("\n")}\n`);
}

/** The positions in an OBJ file. */
export function readPositions(file) {
    return readFileSync(file, "utf8")
        .split("\n")
        .filter((line) => line.startsWith("v "))
        .map((line) => line.trim().split(/\s+/).slice(1, 4).map(Number));
}

/** The vertex ids in a landmark file. */
export function readLandmarks(file) {
    return readFileSync(file, "utf8").trim().split(/\s+/).map(Number);
}

/**
 * A triangulation of the sphere by landmarks on a star-shaped (or not too different) target: the
 * convex hull of their directions from their centre.
 */
export function hullOfLandmarks(positions) {
    const centre = [0, 1, 2].map(
        (axis) => positions.reduce((sum, p) => sum + p[axis], 0) / positions.length,
    );
    return convexHull(positions.map((p) => normalized(minus(p, centre))));
}
