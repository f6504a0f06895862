import {
    BufferAttribute,
    BufferGeometry,
    Color,
    ShapeUtils,
    Triangle,
    Vector2,
    Vector3,
} from "three";
import type {
    EmbeddedEdge,
    LayoutInfo,
    Polylines,
    QuadMesh,
    RefinedMesh,
    TargetInfo,
} from "layout-embedding";
import { groupsOf, membersOf, type Groups } from "../model/groups.js";

/** Area-weighted unit normals of a triangle mesh. */
export function vertexNormals(
    positions: ArrayLike<number>,
    triangles: Uint32Array,
): Float32Array<ArrayBuffer> {
    const normals = new Float32Array(positions.length);
    for (let t = 0; t < triangles.length; t += 3) {
        const [a, b, c] = [3 * triangles[t]!, 3 * triangles[t + 1]!, 3 * triangles[t + 2]!];
        const ux = positions[b]! - positions[a]!;
        const uy = positions[b + 1]! - positions[a + 1]!;
        const uz = positions[b + 2]! - positions[a + 2]!;
        const vx = positions[c]! - positions[a]!;
        const vy = positions[c + 1]! - positions[a + 1]!;
        const vz = positions[c + 2]! - positions[a + 2]!;
        const nx = uy * vz - uz * vy;
        const ny = uz * vx - ux * vz;
        const nz = ux * vy - uy * vx;
        for (const corner of [a, b, c]) {
            normals[corner]! += nx;
            normals[corner + 1]! += ny;
            normals[corner + 2]! += nz;
        }
    }
    for (let i = 0; i < normals.length; i += 3) {
        const [x, y, z] = [normals[i]!, normals[i + 1]!, normals[i + 2]!];
        const length = Math.hypot(x, y, z) || 1;
        normals[i] = x / length;
        normals[i + 1] = y / length;
        normals[i + 2] = z / length;
    }
    return normals;
}

/** The target in one colour. */
export function plainSurface(
    { positions, corners }: TargetInfo,
    normals: Float32Array<ArrayBuffer>,
): BufferGeometry {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
    geometry.setAttribute("normal", new BufferAttribute(normals, 3));
    geometry.setIndex(new BufferAttribute(corners, 1));
    return geometry;
}

/** A surface whose triangles are in the order of its faces: patches, or faces of the layout. */
export interface FacedSurface {
    readonly geometry: BufferGeometry;
    /** Per face: its first corner; one more number than there are faces. */
    readonly faceOffsets: Uint32Array;
}

/** Triangles with a layout face each. */
export type PatchedMesh = Pick<RefinedMesh, "positions" | "corners" | "patches">;

/** The quads as triangles, cut along their shorter diagonals. */
export function trianglesOf({ positions, quads, faces }: QuadMesh): PatchedMesh {
    const corners = new Uint32Array(6 * faces.length);
    const patches = new Int32Array(2 * faces.length);
    const distance = (a: number, b: number) =>
        Math.hypot(...[0, 1, 2].map((i) => positions[3 * a + i]! - positions[3 * b + i]!));
    faces.forEach((face, q) => {
        const [a = 0, b = 0, c = 0, d = 0] = quads.subarray(4 * q, 4 * q + 4);
        corners.set(
            distance(a, c) <= distance(b, d) ? [a, b, c, a, c, d] : [a, b, d, b, c, d],
            6 * q,
        );
        patches.fill(face, 2 * q, 2 * q + 2);
    });
    return { positions, corners, patches };
}

/**
 * The refined mesh with a colour per patch. Vertices between patches are doubled, one copy per
 * patch, so that the colours stay sharp while the shading stays smooth. What lies outside all
 * patches comes last.
 */
export function patchSurface(
    refined: PatchedMesh,
    colorOfPatch: Uint32Array,
    outside: string,
): FacedSurface {
    const { positions, corners: triangles, patches } = refined;
    const vertexCount = positions.length / 3;
    const normals = vertexNormals(positions, triangles);
    // Copies of a vertex form a chain: copy i belongs to patch patchOf[i], the next one is nextOf[i].
    const none = 0xffffffff;
    const unseen = -2;
    let capacity = vertexCount + 1024;
    let original = new Uint32Array(capacity);
    let patchOf = new Int32Array(capacity).fill(unseen);
    let nextOf = new Uint32Array(capacity).fill(none);
    let count = vertexCount;
    for (let v = 0; v < vertexCount; ++v) original[v] = v;
    const grow = () => {
        capacity *= 2;
        const enlarged = <Ids extends Uint32Array | Int32Array>(old: Ids, larger: Ids): Ids => {
            larger.set(old);
            return larger;
        };
        original = enlarged(original, new Uint32Array(capacity));
        patchOf = enlarged(patchOf, new Int32Array(capacity));
        nextOf = enlarged(nextOf, new Uint32Array(capacity));
    };
    const patchCount = colorOfPatch.length;
    const placeOf = (patch: number) => (patch < 0 ? patchCount : patch);
    const faceOffsets = new Uint32Array(patchCount + 2);
    for (const patch of patches) faceOffsets[placeOf(patch) + 1]! += 3;
    for (let p = 0; p <= patchCount; ++p) faceOffsets[p + 1]! += faceOffsets[p]!;
    const filled = faceOffsets.slice();
    const index = new Uint32Array(triangles.length);
    for (let i = 0; i < triangles.length; ++i) {
        const patch = patches[Math.floor(i / 3)]!;
        let copy = triangles[i]!;
        if (patchOf[copy] === unseen) patchOf[copy] = patch;
        while (patchOf[copy] !== patch) {
            if (nextOf[copy] === none) {
                if (count === capacity) grow();
                original[count] = triangles[i]!;
                patchOf[count] = patch;
                nextOf[count] = none;
                nextOf[copy] = count++;
            }
            copy = nextOf[copy]!;
        }
        index[filled[placeOf(patch)]!++] = copy;
    }

    const palette = Array.from(colorOfPatch, (hex) => new Color(hex));
    const fallback = new Color(outside);
    const place = new Float32Array(3 * count);
    const normal = new Float32Array(3 * count);
    const color = new Float32Array(3 * count);
    for (let i = 0; i < count; ++i) {
        const from = 3 * original[i]!;
        const fill = palette[patchOf[i]!] ?? fallback;
        for (let c = 0; c < 3; ++c) {
            place[3 * i + c] = positions[from + c]!;
            normal[3 * i + c] = normals[from + c]!;
        }
        color[3 * i] = fill.r;
        color[3 * i + 1] = fill.g;
        color[3 * i + 2] = fill.b;
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(place, 3));
    geometry.setAttribute("normal", new BufferAttribute(normal, 3));
    geometry.setAttribute("color", new BufferAttribute(color, 3));
    geometry.setIndex(new BufferAttribute(index, 1));
    return { geometry, faceOffsets: faceOffsets.subarray(0, patchCount + 1) };
}

/** Surface area per patch. */
export function patchAreas(refined: RefinedMesh, patchCount: number): Float64Array {
    const areas = new Float64Array(patchCount);
    const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
    refined.patches.forEach((patch, t) => {
        if (patch < 0) return;
        a.fromArray(refined.positions, 3 * refined.corners[3 * t]!);
        b.fromArray(refined.positions, 3 * refined.corners[3 * t + 1]!).sub(a);
        c.fromArray(refined.positions, 3 * refined.corners[3 * t + 2]!).sub(a);
        areas[patch]! += b.cross(c).length() / 2;
    });
    return areas;
}

/** Finds the patch at a point of a target face. */
export class PatchFinder {
    private readonly triangles: Groups;

    constructor(
        private readonly refined: RefinedMesh,
        faceCount: number,
    ) {
        this.triangles = groupsOf(refined.triangleFaces, faceCount);
    }

    /** The layout face; -1 outside all of them. */
    at(face: number, point: Vector3): number {
        const { positions, corners, patches } = this.refined;
        const corner = (t: number, i: number) =>
            new Vector3().fromArray(positions, 3 * corners[3 * t + i]!);
        let best = -1;
        let bestShare = -Infinity;
        for (const t of membersOf(this.triangles, face)) {
            const [a, b, c] = [corner(t, 0), corner(t, 1), corner(t, 2)];
            const at = Triangle.getBarycoord(point, a, b, c, new Vector3());
            const share = at ? Math.min(at.x, at.y, at.z) : -Infinity;
            if (share > bestShare) [best, bestShare] = [patches[t]!, share];
        }
        return best;
    }
}

/** The layout's polygons, flat, each in its colour. */
export function layoutSurface(layout: LayoutInfo, colorOfFace: Uint32Array): FacedSurface {
    const position: number[] = [];
    const color: number[] = [];
    const faceOffsets = new Uint32Array(layout.offsets.length);
    const fill = new Color();
    for (let f = 0; f + 1 < layout.offsets.length; ++f) {
        const face = layout.corners.subarray(layout.offsets[f], layout.offsets[f + 1]);
        const points = Array.from(face, (v) => new Vector3().fromArray(layout.positions, 3 * v));
        fill.setHex(colorOfFace[f]!);
        const triangles = triangulate(points);
        for (const corner of triangles.flat()) {
            position.push(...points[corner]!.toArray());
            color.push(fill.r, fill.g, fill.b);
        }
        faceOffsets[f + 1] = position.length / 3;
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(position), 3));
    geometry.setAttribute("color", new BufferAttribute(new Float32Array(color), 3));
    geometry.computeVertexNormals();
    return { geometry, faceOffsets };
}

/** Triangles of a polygon that need not be flat or convex, as places in `points`. */
function triangulate(points: readonly Vector3[]): number[][] {
    if (points.length === 3) return [[0, 1, 2]];
    // Newell's normal is the polygon's area vector, whatever its shape.
    const normal = new Vector3();
    points.forEach((p, i) => {
        normal.add(new Vector3().crossVectors(p, points[(i + 1) % points.length]!));
    });
    normal.normalize();
    const u = new Vector3(Math.abs(normal.x) < 0.9 ? 1 : 0, Math.abs(normal.x) < 0.9 ? 0 : 1, 0)
        .cross(normal)
        .normalize();
    const v = new Vector3().crossVectors(normal, u);
    return ShapeUtils.triangulateShape(
        points.map((p) => new Vector2(p.dot(u), p.dot(v))),
        [],
    );
}

/** The chains of an embedding, or of a quad mesh, as polylines. */
export function chainPaths(
    edges: readonly Pick<EmbeddedEdge, "id" | "chain">[],
    refined: Pick<RefinedMesh, "positions">,
): Polylines {
    const offsets = new Uint32Array(edges.length + 1);
    edges.forEach((edge, i) => {
        offsets[i + 1] = offsets[i]! + edge.chain.length;
    });
    const points = new Float64Array(3 * offsets[edges.length]!);
    let place = 0;
    for (const { chain } of edges)
        for (const v of chain)
            for (let c = 0; c < 3; ++c) points[place++] = refined.positions[3 * v + c]!;
    return { offsets, points, layoutEdges: Uint32Array.from(edges, (edge) => edge.id) };
}

/** The layout's edges as straight paths, one per edge. */
export function straightEdges(layout: LayoutInfo): Polylines {
    const edgeCount = layout.edges.length / 2;
    const points = new Float64Array(6 * edgeCount);
    layout.edges.forEach((v, i) => {
        points.set(layout.positions.subarray(3 * v, 3 * v + 3), 3 * i);
    });
    return {
        offsets: Uint32Array.from({ length: edgeCount + 1 }, (_, i) => 2 * i),
        points,
        layoutEdges: Uint32Array.from({ length: edgeCount }, (_, i) => i),
    };
}
