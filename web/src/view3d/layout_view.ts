import { DoubleSide, FrontSide, Raycaster } from "three";
import type { LayoutInfo } from "layout-embedding";
import type { Landmarks } from "../model/landmarks.js";
import { patchColors } from "./colors.js";
import { layoutSurface, straightEdges, vertexNormals } from "./geometry.js";
import { MeshView, type ViewHit, type ViewListener } from "./mesh_view.js";

/** The layout with its faces in the colours of their patches. */
export class LayoutView extends MeshView {
    private layout: LayoutInfo | null = null;
    private normals = new Float32Array();

    constructor(host: HTMLElement, label: string, listener: ViewListener) {
        // At sharp corners the mean normal tells nothing: what hides a dot is the faces before it.
        super(host, label, -2, listener);
    }

    setLayout(layout: LayoutInfo | null): void {
        this.layout = layout;
        const made = layout ? layoutSurface(layout, patchColors(layout)) : null;
        this.normals = layout ? vertexNormals(layout.positions, fans(layout)) : new Float32Array();
        this.material.vertexColors = true;
        this.material.flatShading = true;
        this.material.side = this.side();
        this.material.needsUpdate = true;
        this.setSurfaceGeometry(made);
        this.viewer.frameOn(layout?.positions ?? []);
        this.shownPaths = layout ? straightEdges(layout) : null;
        this.tubes.setPaths(this.shownPaths);
        this.viewer.requestRender();
    }

    /** Vertices without a landmark are drawn as rings. */
    setLandmarks(landmarks: Landmarks | null): void {
        const { layout, normals } = this;
        const three = (from: ArrayLike<number>, v: number) => [
            from[3 * v]!,
            from[3 * v + 1]!,
            from[3 * v + 2]!,
        ];
        const count = layout?.vertexCount ?? 0;
        this.shownDots = Array.from({ length: count }, (_, id) => ({
            id,
            place: three(layout!.positions, id),
            normal: three(normals, id),
            hollow: (landmarks?.places[id] ?? null) === null,
        }));
        this.dots.setDots(this.shownDots, this.viewer.radius, count);
        this.viewer.requestRender();
    }

    protected override surfaceAt(x: number, y: number): ViewHit | null {
        if (!this.mesh.visible) return null;
        const caster = new Raycaster();
        caster.ray.copy(this.viewer.ray(x, y));
        const [hit] = caster.intersectObject(this.mesh, false);
        const face = hit?.faceIndex ?? null;
        if (!hit || face === null) return null;
        const patch = this.faceOffsets.findIndex((begin) => begin > 3 * face) - 1;
        return { face, point: hit.point, distance: hit.distance, patch };
    }

    protected override vertexAt(): null {
        return null;
    }

    protected override side(): 0 | 2 {
        return (this.layout?.boundaryLoopCount ?? 0) > 0 ? DoubleSide : FrontSide;
    }
}

/** The layout's faces as fans of triangles: good enough for normals. */
function fans(layout: LayoutInfo): Uint32Array {
    const triangles: number[] = [];
    for (let f = 0; f + 1 < layout.offsets.length; ++f)
        for (let i = layout.offsets[f]! + 1; i + 1 < layout.offsets[f + 1]!; ++i)
            triangles.push(
                layout.corners[layout.offsets[f]!]!,
                layout.corners[i]!,
                layout.corners[i + 1]!,
            );
    return Uint32Array.from(triangles);
}
