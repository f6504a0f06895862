import { subdivided, triangulated, type Polygons } from "./polygons.js";

const cube: Polygons = {
    positions: [-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1],
    faces: [
        [0, 3, 2, 1],
        [4, 5, 6, 7],
        [0, 1, 5, 4],
        [1, 2, 6, 5],
        [2, 3, 7, 6],
        [3, 0, 4, 7],
    ],
};

/** A bumpy, stretched ball over the direction (x, y, z) of length 1. */
function radius(x: number, y: number, z: number): number {
    return (
        1 +
        0.16 * Math.sin(4 * x + 1) * Math.cos(3 * y) +
        0.12 * Math.sin(5 * z + 2 * x) +
        0.07 * Math.cos(7 * y - 3 * z)
    );
}

/**
 * A bumpy pebble with the eight corners of a cube on it. The upper four are turned about the
 * vertical axis, so that edges get in each other's way and the order of insertion matters.
 */
export function pebble(): { layout: Polygons; target: Polygons; landmarks: number[] } {
    let ball = cube;
    for (let level = 0; level < 6; ++level) ball = subdivided(ball);
    const directions: number[] = [];
    const positions: number[] = [];
    for (let v = 0; v < ball.positions.length; v += 3) {
        const [x, y, z] = ball.positions.slice(v, v + 3) as [number, number, number];
        const length = Math.sqrt(x * x + y * y + z * z);
        const [dx, dy, dz] = [x / length, y / length, z / length];
        const r = radius(dx, dy, dz);
        directions.push(dx, dy, dz);
        positions.push(1.45 * r * dx, r * dy, 1.05 * r * dz);
    }
    const nearest = (x: number, y: number, z: number) => {
        let best = 0;
        let bestDot = -Infinity;
        for (let v = 0; v < directions.length / 3; ++v) {
            const dot =
                x * directions[3 * v]! + y * directions[3 * v + 1]! + z * directions[3 * v + 2]!;
            if (dot > bestDot) [best, bestDot] = [v, dot];
        }
        return best;
    };
    const landmarks: number[] = [];
    for (let v = 0; v < 8; ++v) {
        const [x, y, z] = cube.positions.slice(3 * v, 3 * v + 3) as [number, number, number];
        const turn = y > 0 ? 3.2 : 0.1 * v;
        const [c, s] = [Math.cos(turn), Math.sin(turn)];
        landmarks.push(nearest(c * x + s * z, y * (0.6 + 0.12 * (v % 3)), c * z - s * x));
    }
    return { layout: cube, target: triangulated({ positions, faces: ball.faces }), landmarks };
}
