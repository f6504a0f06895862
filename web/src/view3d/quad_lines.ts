import {
    BufferAttribute,
    BufferGeometry,
    Group,
    LineBasicMaterial,
    LineSegments,
    type Plane,
} from "three";
import type { QuadMesh } from "layout-embedding";
import type { ViewTheme } from "./colors.js";

/** The edges of a quad mesh; those of the base complex inside of layout faces are stronger. */
export class QuadLines {
    readonly group = new Group();
    private readonly fine = new LineBasicMaterial({ transparent: true, opacity: 0.42 });
    private readonly strong = new LineBasicMaterial();

    setTheme(theme: ViewTheme): void {
        this.fine.color.set(theme.ink);
        this.strong.color.set(theme.ink);
    }

    /** `layoutEdges` of the chains are drawn otherwise. */
    setMesh(mesh: QuadMesh | null, layoutEdges: number): void {
        for (const child of this.group.children)
            if (child instanceof LineSegments) (child.geometry as BufferGeometry).dispose();
        this.group.clear();
        if (!mesh) return;
        const position = new BufferAttribute(new Float32Array(mesh.positions), 3);
        this.add(position, edgesOf(mesh), this.fine);
        this.add(position, chainEdges(mesh.chains.slice(layoutEdges)), this.strong);
    }

    setClip(planes: Plane[] | null): void {
        for (const material of [this.fine, this.strong]) {
            material.clippingPlanes = planes;
            material.needsUpdate = true;
        }
    }

    private add(position: BufferAttribute, pairs: Uint32Array, material: LineBasicMaterial): void {
        const geometry = new BufferGeometry();
        geometry.setAttribute("position", position);
        geometry.setIndex(new BufferAttribute(pairs, 1));
        this.group.add(new LineSegments(geometry, material));
    }
}

/** Each edge once: the two quads at it run along it in opposite directions, and a boundary is chains. */
function edgesOf({ quads }: QuadMesh): Uint32Array {
    const pairs: number[] = [];
    for (let i = 0; i < quads.length; ++i) {
        const a = quads[i]!;
        const b = quads[i - (i % 4) + ((i + 1) % 4)]!;
        if (a < b) pairs.push(a, b);
    }
    return Uint32Array.from(pairs);
}

function chainEdges(chains: readonly Uint32Array[]): Uint32Array {
    const pairs = chains.flatMap((chain) =>
        Array.from(chain.subarray(1), (vertex, i) => [chain[i]!, vertex]).flat(),
    );
    return Uint32Array.from(pairs);
}
