// Meshes that the tests hand to the page as files.
import { subdivided, triangulated, type Polygons } from "../../web/src/examples/polygons.js";

export type { Polygons };

export const cube: Polygons = {
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

/** A ball of 12 * 4^levels triangles; its first eight vertices are those of the cube. */
export function ball(levels: number): Polygons {
    let mesh = cube;
    for (let level = 0; level < levels; ++level) mesh = subdivided(mesh);
    return triangulated(mesh);
}

export function toObj({ positions, faces }: Polygons): string {
    const lines: string[] = [];
    for (let i = 0; i < positions.length; i += 3)
        lines.push(`v ${positions.slice(i, i + 3).join(" ")}`);
    for (const face of faces) lines.push(`f ${face.map((v) => v + 1).join(" ")}`);
    return lines.join("\n") + "\n";
}

export function toOff({ positions, faces }: Polygons): string {
    const lines = ["OFF", `${positions.length / 3} ${faces.length} 0`];
    for (let i = 0; i < positions.length; i += 3) lines.push(positions.slice(i, i + 3).join(" "));
    for (const face of faces) lines.push(`${face.length} ${face.join(" ")}`);
    return lines.join("\n") + "\n";
}

export function toPly({ positions, faces }: Polygons): string {
    const lines = ["ply", "format ascii 1.0", `element vertex ${positions.length / 3}`];
    for (const axis of ["x", "y", "z"]) lines.push(`property double ${axis}`);
    lines.push(`element face ${faces.length}`, "property list uchar int vertex_indices");
    lines.push("end_header");
    for (let i = 0; i < positions.length; i += 3) lines.push(positions.slice(i, i + 3).join(" "));
    for (const face of faces) lines.push(`${face.length} ${face.join(" ")}`);
    return lines.join("\n") + "\n";
}

/** Triangles only. */
export function toStl({ positions, faces }: Polygons): string {
    const lines = ["solid"];
    for (const face of faces) {
        lines.push("facet normal 0 0 0", "outer loop");
        for (const v of face) lines.push(`vertex ${positions.slice(3 * v, 3 * v + 3).join(" ")}`);
        lines.push("endloop", "endfacet");
    }
    return [...lines, "endsolid"].join("\n") + "\n";
}
