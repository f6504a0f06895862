// Every kind of bad input that a layout, a target or landmarks can be, for the tests through the API,
// the command line and the page.
import { cube, obj, octahedron, sphere, torus, type Mesh } from "./meshes.js";

export interface BadInput {
    name: string;
    code: string;
    layout?: string;
    target?: string;
    landmarks?: string;
    /** Of the target's and of the landmarks' file, "obj" and "txt" otherwise. */
    targetFormat?: string;
    landmarkFormat?: string;
    repair?: boolean;
}

export const ball = sphere(2);

/** The ball with its faces changed. */
function ballWith(change: (faces: number[][]) => number[][]): string {
    return obj({ positions: ball.positions, faces: change(structuredClone(ball.faces)) });
}

/** The ball with the x coordinate of vertex 7 replaced by other text. */
function ballAt(x: string): string {
    const lines = obj(ball).split("\n");
    lines[7] = `v ${x} 0 0`;
    return lines.join("\n");
}

/** Two meshes in one. */
function both(a: Mesh, b: Mesh): Mesh {
    const shift = a.positions.length / 3;
    return {
        positions: [...a.positions, ...b.positions.map((x) => x + 10)],
        faces: [...a.faces, ...b.faces.map((face) => face.map((vertex) => vertex + shift))],
    };
}

const manyCorners = `${"v 0 0 0\n".repeat(300)}f ${Array.from({ length: 256 }, (_, i) => i + 1).join(" ")}\n`;

export const badInputs: BadInput[] = [
    { name: "empty_target", code: "fileEmpty", target: "" },
    { name: "empty_layout", code: "fileEmpty", layout: " \n\n" },
    { name: "empty_landmarks", code: "fileEmpty", landmarks: "\n" },
    { name: "not_a_mesh", code: "unknownFormat", target: "\x89PNG\r\n\x1a\n\0\0\0" },
    { name: "damaged_line", code: "syntaxError", target: ballAt("one") },
    {
        name: "index_out_of_range",
        code: "indexOutOfRange",
        target: ballWith((f) => [...f, [0, 1, 999]]),
    },
    { name: "no_faces", code: "noFaces", target: "v 0 0 0\nv 1 0 0\nv 0 1 0\n" },
    { name: "over_255_corners", code: "faceTooLarge", layout: manyCorners },
    { name: "quads", code: "notTriangles", target: obj(cube) },
    { name: "non_manifold_edge", code: "nonManifoldEdge", target: nonManifold() },
    { name: "non_manifold_vertex", code: "nonManifoldVertex", target: pinched() },
    {
        name: "inconsistent_orientation",
        code: "inconsistentOrientation",
        target: ballWith(([first, ...rest]) => [first!.reverse(), ...rest]),
    },
    { name: "several_components", code: "severalComponents", target: obj(both(ball, ball)) },
    { name: "disconnected_layout", code: "severalComponents", layout: obj(both(octahedron, cube)) },
    {
        name: "torus_target",
        code: "topologyMismatch",
        target: obj(torus(9, 7)),
        landmarks: "0\n9\n20\n31\n42\n55\n",
    },
    { name: "holed_target", code: "topologyMismatch", target: ballWith((faces) => faces.slice(1)) },
    { name: "landmark_out_of_range", code: "landmarkOutOfRange", landmarks: "0\n1\n2\n3\n4\n66\n" },
    { name: "negative_landmark", code: "landmarkOutOfRange", landmarks: "0\n1\n2\n3\n4\n-1\n" },
    { name: "landmark_that_is_no_number", code: "syntaxError", landmarks: "0\n1\n2\n3\n4\nfive\n" },
    { name: "duplicate_landmark", code: "duplicateLandmark", landmarks: "0\n1\n2\n3\n4\n2\n" },
    { name: "too_few_landmarks", code: "landmarkCount", landmarks: "0\n1\n2\n3\n4\n" },
    { name: "too_many_landmarks", code: "landmarkCount", landmarks: "0\n1\n2\n3\n4\n5\n6\n" },
    {
        name: "layout_with_a_loop",
        code: "layoutLoop",
        layout: "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 2 3\nf 3 2 1\n",
    },
    { name: "non_manifold_layout", code: "nonManifoldEdge", layout: nonManifold() },
    { name: "not_a_number", code: "nonFinitePosition", target: ballAt("nan") },
    { name: "infinite", code: "nonFinitePosition", target: ballAt("inf") },
    { name: "absurdly_large", code: "coordinateTooLarge", target: ballAt("1e200") },
    { name: "unused_vertex", code: "unusedVertex", target: `${obj(ball)}v 5 5 5\n` },
    { name: "degenerate_face", code: "degenerateFace", target: ballWith((f) => [...f, [0, 0, 1]]) },
    { name: "vertices_in_two_places", code: "coincidentVertices", target: unwelded() },
    {
        name: "landmark_of_an_inner_vertex_on_the_boundary",
        code: "landmarkOnBoundary",
        layout: obj({ ...octahedron, faces: octahedron.faces.slice(1) }),
        target: ballWith((faces) => faces.slice(1)),
        landmarks: `0\n${boundaryVertex()}\n2\n3\n4\n5\n`,
    },
    {
        name: "points_on_a_repaired_target",
        code: "landmarkNeedsTarget",
        target: `${obj(ball)}v 5 5 5\n`,
        landmarks: octahedron.positions
            .join(" ")
            .replace(/(\S+) (\S+) (\S+) ?/g, '<point x="$1" y="$2" z="$3" active="1"/>\n'),
        landmarkFormat: "pp",
        repair: true,
    },
    {
        name: "more_vertices_than_ids",
        code: "tooLarge",
        target: "OFF\n5000000000 1 0\n0 0 0\n",
        targetFormat: "off",
    },
    { name: "duplicate_face", code: "duplicateFace", target: ballWith((f) => [...f, f[3]!]) },
];

/** The ball with a fin: three faces at one edge. */
function nonManifold(): string {
    return obj({
        positions: [...ball.positions, 2, 2, 2],
        faces: [...ball.faces, [ball.faces[0]![0]!, ball.faces[0]![1]!, ball.positions.length / 3]],
    });
}

/** The ball, its faces without common vertices. */
function unwelded(): string {
    const corners = ball.faces.flat();
    return obj({
        positions: corners.flatMap((v) => ball.positions.slice(3 * v, 3 * v + 3)),
        faces: ball.faces.map((_, f) => [3 * f, 3 * f + 1, 3 * f + 2]),
    });
}

/** A vertex of the ball's first face that is none of the octahedron's. */
function boundaryVertex(): number {
    return ball.faces[0]!.find((vertex) => vertex > 5)!;
}

/** Two balls that touch in one vertex. */
function pinched(): string {
    const mesh = both(ball, ball);
    const shift = ball.positions.length / 3;
    const faces = mesh.faces.map((face) =>
        face.map((v) => (v === shift ? 0 : v > shift ? v - 1 : v)),
    );
    mesh.positions.splice(3 * shift, 3);
    return obj({ positions: mesh.positions, faces });
}

const good = { layout: obj(octahedron), target: obj(ball), landmarks: "0\n1\n2\n3\n4\n5\n" };

/** The three files of a bad input by name, what is not bad filled in. */
export function filesOf(bad: BadInput) {
    const { targetFormat = "obj", landmarkFormat = "txt" } = bad;
    return {
        layout: { name: "layout.obj", text: bad.layout ?? good.layout },
        target: { name: `target.${targetFormat}`, text: bad.target ?? good.target },
        landmarks: { name: `landmarks.${landmarkFormat}`, text: bad.landmarks ?? good.landmarks },
    };
}
