import { BufferAttribute, BufferGeometry, DoubleSide, Vector3, type Ray } from "three";
import { MeshBVH } from "three-mesh-bvh";

/** Where a ray meets the surface first. */
export interface SurfaceHit {
    readonly face: number;
    readonly point: Vector3;
    readonly distance: number;
}

/** Triangles in a leaf of the tree: more make it quicker to build and slower to ask, both a little. */
const leafSize = 24;

/**
 * Finds triangles under the pointer. The tree behind it takes half a second for a million triangles:
 * it is built when the browser has nothing else to do, or when it is first needed.
 */
export class SurfacePicker {
    private tree: MeshBVH | null = null;
    private neighbours: { offsets: Uint32Array; ids: Uint32Array } | null = null;

    constructor(
        private readonly positions: Float64Array,
        private readonly corners: Uint32Array,
    ) {
        const prepare = () => {
            this.tree ??= this.build();
        };
        if ("requestIdleCallback" in globalThis) requestIdleCallback(prepare);
        else setTimeout(prepare, 500);
    }

    hit(ray: Ray): SurfaceHit | null {
        this.tree ??= this.build();
        const found = this.tree.raycastFirst(ray, DoubleSide);
        const face = found?.faceIndex ?? null;
        if (!found || face === null) return null;
        return { face, point: found.point, distance: found.distance };
    }

    /** The corner of a face nearest to a point that `allowed` lets pass; null if none does. */
    nearestCorner(
        { face, point }: SurfaceHit,
        allowed: (vertex: number) => boolean,
    ): number | null {
        let best: number | null = null;
        let bestDistance = Infinity;
        for (const vertex of this.corners.subarray(3 * face, 3 * face + 3)) {
            const distance = this.place(vertex).distanceToSquared(point);
            if (distance < bestDistance && allowed(vertex))
                [best, bestDistance] = [vertex, distance];
        }
        return best;
    }

    /** The neighbour of a vertex that lies most in a direction; null if none does. */
    neighbourTowards(
        vertex: number,
        direction: Vector3,
        allowed: (vertex: number) => boolean,
    ): number | null {
        this.neighbours ??= this.findNeighbours();
        const { offsets, ids } = this.neighbours;
        const from = this.place(vertex);
        let best: number | null = null;
        let bestCosine = 0.2;
        for (const other of ids.subarray(offsets[vertex], offsets[vertex + 1])) {
            const cosine = this.place(other).sub(from).normalize().dot(direction);
            if (cosine > bestCosine && allowed(other)) [best, bestCosine] = [other, cosine];
        }
        return best;
    }

    place(vertex: number): Vector3 {
        return new Vector3().fromArray(this.positions, 3 * vertex);
    }

    private build(): MeshBVH {
        const geometry = new BufferGeometry();
        geometry.setAttribute("position", new BufferAttribute(new Float32Array(this.positions), 3));
        geometry.setIndex(new BufferAttribute(this.corners, 1));
        // Indirect: the faces keep their numbers.
        return new MeshBVH(geometry, { indirect: true, targetLeafSize: leafSize });
    }

    private findNeighbours(): { offsets: Uint32Array; ids: Uint32Array } {
        const { corners } = this;
        const offsets = new Uint32Array(this.positions.length / 3 + 1);
        for (const v of corners) offsets[v + 1]! += 2;
        for (let v = 1; v < offsets.length; ++v) offsets[v]! += offsets[v - 1]!;
        const ids = new Uint32Array(2 * corners.length);
        const filled = offsets.slice();
        for (let i = 0; i < corners.length; ++i) {
            const first = i - (i % 3);
            const v = corners[i]!;
            ids[filled[v]!++] = corners[first + ((i + 1) % 3)]!;
            ids[filled[v]!++] = corners[first + ((i + 2) % 3)]!;
        }
        return { offsets, ids };
    }
}
