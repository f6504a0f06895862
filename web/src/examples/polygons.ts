/** Polygon meshes as the examples build them. */
export interface Polygons {
    /** 3 coordinates per vertex. */
    positions: number[];
    /** Vertex ids per face, counter-clockwise seen from outside. */
    faces: number[][];
}

/**
 * Rounds coordinates to multiples of 2^-24, so that engines whose sine differs in the last bit still
 * make the same mesh.
 */
export function rounded(positions: readonly number[]): Float64Array {
    const unit = 2 ** 24;
    return Float64Array.from(positions, (x) => Math.round(x * unit) / unit);
}

export function flattened(faces: readonly (readonly number[])[]): {
    corners: Uint32Array;
    offsets: Uint32Array;
} {
    const offsets = new Uint32Array(faces.length + 1);
    faces.forEach((face, i) => {
        offsets[i + 1] = offsets[i]! + face.length;
    });
    return { corners: Uint32Array.from(faces.flat()), offsets };
}

/** Cuts every quad along its shorter diagonal (the first one if they are equal). */
export function triangulated({ positions, faces }: Polygons): Polygons {
    const squaredDistance = (a: number, b: number) =>
        [0, 1, 2].reduce((sum, i) => sum + (positions[3 * a + i]! - positions[3 * b + i]!) ** 2, 0);
    const triangles = faces.flatMap((face) => {
        const [a, b, c, d] = face;
        if (d === undefined) return [face];
        return squaredDistance(a!, c!) <= squaredDistance(b!, d)
            ? [
                  [a!, b!, c!],
                  [a!, c!, d],
              ]
            : [
                  [b!, c!, d],
                  [b!, d, a!],
              ];
    });
    return { positions, faces: triangles };
}

/**
 * The surface of a set of unit cells, given by their integer corners nearest the origin; `place`
 * puts each lattice point somewhere. Cells may touch along faces only.
 */
export function cellSurface(
    cells: readonly (readonly [number, number, number])[],
    place: (i: number, j: number, k: number) => readonly [number, number, number],
): Polygons {
    const full = new Set(cells.map(String));
    const ids = new Map<string, number>();
    const positions: number[] = [];
    const vertex = (p: readonly number[]): number => {
        const key = String(p);
        let id = ids.get(key);
        if (id === undefined) {
            id = ids.size;
            ids.set(key, id);
            positions.push(...place(p[0]!, p[1]!, p[2]!));
        }
        return id;
    };
    const faces: number[][] = [];
    for (const cell of cells) {
        for (const axis of [0, 1, 2]) {
            for (const side of [0, 1]) {
                const neighbour = [...cell];
                neighbour[axis]! += side === 1 ? 1 : -1;
                if (full.has(String(neighbour))) continue;
                const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
                const corner = (du: number, dv: number) => {
                    const p = [...cell];
                    p[axis]! += side;
                    p[u]! += du;
                    p[v]! += dv;
                    return vertex(p);
                };
                const loop = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                faces.push(side === 1 ? loop : loop.reverse());
            }
        }
    }
    return { positions, faces };
}

/**
 * One step of Catmull-Clark subdivision of a closed mesh [CC78]. The vertices keep their ids; edge
 * points and face points follow.
 */
export function subdivided({ positions, faces }: Polygons): Polygons {
    const vertexCount = positions.length / 3;
    const edges = new Map<number, { id: number; ends: [number, number]; faces: number[] }>();
    const key = (a: number, b: number) => Math.min(a, b) * vertexCount + Math.max(a, b);
    faces.forEach((face, f) => {
        face.forEach((a, i) => {
            const b = face[(i + 1) % face.length]!;
            const edge = edges.get(key(a, b));
            if (edge) edge.faces.push(f);
            else edges.set(key(a, b), { id: edges.size, ends: [a, b], faces: [f] });
        });
    });
    const mean = (source: ArrayLike<number>, ids: readonly number[]) =>
        [0, 1, 2].map((c) => ids.reduce((sum, id) => sum + source[3 * id + c]!, 0) / ids.length);

    const facePoints = faces.flatMap((face) => mean(positions, face));
    const edgePoints: number[] = [];
    const valence = new Float64Array(vertexCount);
    const edgeSums = new Float64Array(3 * vertexCount);
    for (const { ends, faces: sides } of edges.values()) {
        const middle = mean(positions, ends);
        const beside = mean(facePoints, sides);
        edgePoints.push(...middle.map((x, c) => (x + beside[c]!) / 2));
        for (const v of ends) {
            valence[v]! += 1;
            for (let c = 0; c < 3; ++c) edgeSums[3 * v + c]! += middle[c]!;
        }
    }
    const faceSums = new Float64Array(3 * vertexCount);
    faces.forEach((face, f) => {
        for (const v of face)
            for (let c = 0; c < 3; ++c) faceSums[3 * v + c]! += facePoints[3 * f + c]!;
    });
    const moved = positions.map((x, i) => {
        const n = valence[Math.floor(i / 3)]!;
        return (faceSums[i]! / n + (2 * edgeSums[i]!) / n + (n - 3) * x) / n;
    });

    const edgeBase = vertexCount;
    const faceBase = edgeBase + edges.size;
    const edgeVertex = (a: number, b: number) => edgeBase + edges.get(key(a, b))!.id;
    return {
        positions: [...moved, ...edgePoints, ...facePoints],
        faces: faces.flatMap((face, f) =>
            face.map((v, i) => {
                const next = face[(i + 1) % face.length]!;
                const previous = face[(i + face.length - 1) % face.length]!;
                return [v, edgeVertex(v, next), faceBase + f, edgeVertex(previous, v)];
            }),
        ),
    };
}
