// Meshes made by code, as arrays and as OBJ text.

export interface Mesh {
    positions: number[];
    faces: number[][];
}

/** The mesh as the package takes it. */
export function arrays(mesh: Mesh) {
    const offsets = [0];
    for (const face of mesh.faces) {
        offsets.push((offsets.at(-1) ?? 0) + face.length);
    }
    return {
        positions: Float64Array.from(mesh.positions),
        corners: Uint32Array.from(mesh.faces.flat()),
        offsets: Uint32Array.from(offsets),
    };
}

export function obj(mesh: Mesh): string {
    const lines: string[] = [];
    for (let i = 0; i < mesh.positions.length; i += 3) {
        lines.push(`v ${mesh.positions.slice(i, i + 3).join(" ")}`);
    }
    for (const face of mesh.faces) {
        lines.push(`f ${face.map((vertex) => String(vertex + 1)).join(" ")}`);
    }
    return `${lines.join("\n")}\n`;
}

/** The mesh as a file of the given name. */
export function file(mesh: Mesh, name: string) {
    return { bytes: new TextEncoder().encode(obj(mesh)), name };
}

export const octahedron: Mesh = {
    positions: [1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1],
    faces: [
        [0, 2, 4],
        [2, 1, 4],
        [1, 3, 4],
        [3, 0, 4],
        [2, 0, 5],
        [1, 2, 5],
        [3, 1, 5],
        [0, 3, 5],
    ],
};

export const cube: Mesh = {
    positions: [
        [-1, -1, -1],
        [1, -1, -1],
        [1, 1, -1],
        [-1, 1, -1],
        [-1, -1, 1],
        [1, -1, 1],
        [1, 1, 1],
        [-1, 1, 1],
    ].flat(),
    faces: [
        [3, 2, 1, 0],
        [4, 5, 6, 7],
        [0, 1, 5, 4],
        [1, 2, 6, 5],
        [2, 3, 7, 6],
        [3, 0, 4, 7],
    ],
};

/**
 * The octahedron, subdivided and projected to the unit sphere; its first six vertices are the
 * octahedron's.
 */
export function sphere(rounds: number): Mesh {
    const positions = [...octahedron.positions];
    let { faces } = octahedron;
    for (let round = 0; round < rounds; ++round) {
        const midpoints = new Map<string, number>();
        const midpoint = (a: number, b: number) => {
            const key = a < b ? `${String(a)} ${String(b)}` : `${String(b)} ${String(a)}`;
            let vertex = midpoints.get(key);
            if (vertex === undefined) {
                const sum = [0, 1, 2].map((k) => positions[3 * a + k]! + positions[3 * b + k]!);
                const length = Math.sqrt(sum.reduce((total, x) => total + x * x, 0));
                vertex = positions.length / 3;
                positions.push(...sum.map((x) => x / length));
                midpoints.set(key, vertex);
            }
            return vertex;
        };
        faces = faces.flatMap((face) => {
            const [a, b, c] = face as [number, number, number];
            const [ab, bc, ca] = [midpoint(a, b), midpoint(b, c), midpoint(c, a)];
            return [
                [a, ab, ca],
                [ab, b, bc],
                [ca, bc, c],
                [ab, bc, ca],
            ];
        });
    }
    return { positions, faces };
}

/** A grid of quads or triangles, closed in both directions. */
export function torus(around: number, across: number): Mesh {
    const positions: number[] = [];
    const faces: number[][] = [];
    const id = (i: number, j: number) => (i % around) * across + (j % across);
    for (let i = 0; i < around; ++i) {
        for (let j = 0; j < across; ++j) {
            const u = (2 * Math.PI * i) / around;
            const v = (2 * Math.PI * j) / across;
            const radius = 2 + Math.cos(v);
            positions.push(radius * Math.cos(u), radius * Math.sin(u), Math.sin(v));
            const [a, b, c, d] = [id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)];
            faces.push([a, b, c], [a, c, d]);
        }
    }
    return { positions, faces };
}

/** sphere() pushed back onto the flat faces of the octahedron, whose edges are sharp. */
export function creased(rounds: number): Mesh {
    const { positions, faces } = sphere(rounds);
    const flat = positions.map((x, i) => {
        const first = i - (i % 3);
        return x / positions.slice(first, first + 3).reduce((sum, y) => sum + Math.abs(y), 0);
    });
    return { positions: flat, faces };
}

/** Several target vertices of sphere(3) for the octahedron, turned so that paths conflict. */
export const displacedLandmarks = [40, 17, 91, 133, 250, 201];
