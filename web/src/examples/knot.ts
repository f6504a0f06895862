import { triangulated, type Polygons } from "./polygons.js";

type Point = [number, number, number];

const add = (a: Point, b: Point, s = 1): Point => [
    a[0] + s * b[0],
    a[1] + s * b[1],
    a[2] + s * b[2],
];
const scaled = (a: Point, s: number): Point => [s * a[0], s * a[1], s * a[2]];
const dot = (a: Point, b: Point) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Point, b: Point): Point => [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0],
];
const unit = (a: Point) => scaled(a, 1 / Math.sqrt(dot(a, a)));

/** The trefoil knot for t in [0, 2 pi]. */
function trefoil(t: number): Point {
    const r = 2 + Math.cos(3 * t);
    return [r * Math.cos(2 * t), -r * Math.sin(2 * t), 1.3 * Math.sin(3 * t)];
}

/** A tube of quads around a closed curve: `long` rings of `round` vertices; ring i starts at i * round. */
function tube(curve: (t: number) => Point, width: number, long: number, round: number): Polygons {
    const positions: number[] = [];
    for (let i = 0; i < long; ++i) {
        const t = (2 * Math.PI * i) / long;
        const tangent = unit(add(curve(t + 1e-3), curve(t - 1e-3), -1));
        // Away from the axis of the torus that carries the knot: this frame closes up.
        const middle: Point = [2 * Math.cos(2 * t), -2 * Math.sin(2 * t), 0];
        const outward = add(curve(t), middle, -1);
        const normal = unit(add(outward, tangent, -dot(outward, tangent)));
        const binormal = cross(tangent, normal);
        for (let j = 0; j < round; ++j) {
            const angle = (2 * Math.PI * j) / round;
            const offset = add(scaled(normal, Math.cos(angle)), binormal, Math.sin(angle));
            positions.push(...add(curve(t), offset, width));
        }
    }
    const faces: number[][] = [];
    for (let i = 0; i < long; ++i)
        for (let j = 0; j < round; ++j) {
            const [a, b] = [i * round, ((i + 1) % long) * round];
            const next = (j + 1) % round;
            faces.push([a + j, a + next, b + next, b + j]);
        }
    return { positions, faces };
}

/** A knotted tube (genus 1) whose layout is a plain ring: only how cells are joined matters. */
export function knot(): { layout: Polygons; target: Polygons; landmarks: number[] } {
    const [rings, sides] = [12, 3];
    const [long, round] = [216, 18];
    const ring = (t: number): Point => [2 * Math.cos(t), -2 * Math.sin(t), 0];
    const circle: Polygons = ringLayout(ring, rings, sides);
    const landmarks: number[] = [];
    for (let i = 0; i < rings; ++i)
        for (let j = 0; j < sides; ++j)
            landmarks.push(((i * long) / rings) * round + (j * round) / sides);
    return { layout: circle, target: triangulated(tube(trefoil, 0.55, long, round)), landmarks };
}

function ringLayout(curve: (t: number) => Point, rings: number, sides: number): Polygons {
    const positions: number[] = [];
    for (let i = 0; i < rings; ++i) {
        const t = (2 * Math.PI * i) / rings;
        const outward = unit(curve(t));
        for (let j = 0; j < sides; ++j) {
            const angle = (2 * Math.PI * j) / sides;
            const offset = add(scaled(outward, Math.cos(angle)), [0, 0, 1], Math.sin(angle));
            positions.push(...add(curve(t), offset, 0.7));
        }
    }
    const faces: number[][] = [];
    for (let i = 0; i < rings; ++i)
        for (let j = 0; j < sides; ++j) {
            const [a, b] = [i * sides, ((i + 1) % rings) * sides];
            const next = (j + 1) % sides;
            faces.push([a + j, a + next, b + next, b + j]);
        }
    return { positions, faces };
}
