import { BufferGeometry, DoubleSide, FrontSide, Mesh, MeshLambertMaterial } from "three";
import type { EmbedResult, LayoutInfo, Polylines, TargetInfo } from "layout-embedding";
import type { Item } from "../model/state.js";
import { currentTheme, patchColors } from "./colors.js";
import { Dots } from "./dots.js";
import {
    chainPaths,
    layoutSurface,
    patchSurface,
    plainSurface,
    straightEdges,
    vertexNormals,
    type Surface,
} from "./geometry.js";
import { PathLines } from "./lines.js";
import { pick, type Pickable } from "./pick.js";
import { Viewer } from "./viewer.js";

/** A viewer with a surface, paths on it and numbered dots: what both views have in common. */
abstract class MeshView {
    readonly viewer: Viewer;
    /** Called with what the pointer is over. */
    onHover: ((item: Item | null) => void) | null = null;
    protected readonly material = new MeshLambertMaterial({
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
    });
    protected readonly mesh = new Mesh(new BufferGeometry(), this.material);
    protected readonly lines = new PathLines();
    protected readonly dots: Dots;
    private hoverFrame = 0;

    constructor(host: HTMLElement, label: string, horizon: number) {
        this.dots = new Dots(horizon);
        this.viewer = new Viewer(host, label);
        this.mesh.visible = false;
        this.viewer.content.add(this.mesh, this.lines.group, this.dots.points);
        const { canvas } = this.viewer;
        canvas.addEventListener("pointermove", (event) => {
            if (event.buttons !== 0 || this.hoverFrame !== 0) return;
            const { offsetX, offsetY } = event;
            this.hoverFrame = requestAnimationFrame(() => {
                this.hoverFrame = 0;
                this.onHover?.(pick(this.pickable(), this.viewer.camera, canvas, offsetX, offsetY));
            });
        });
        canvas.addEventListener("pointerleave", () => this.onHover?.(null));
    }

    applyTheme(): void {
        const theme = currentTheme();
        this.viewer.setBackground(theme.background);
        this.lines.setTheme(theme);
        this.dots.setTheme(theme);
    }

    highlight(item: Item | null): void {
        this.lines.highlight(item?.kind === "edge" ? item.id : null);
        this.dots.highlight(item?.kind === "vertex" ? item.id : null);
        this.viewer.requestRender();
    }

    protected abstract pickable(): Pickable;

    protected setGeometry(geometry: BufferGeometry | null): void {
        this.mesh.geometry.dispose();
        this.mesh.geometry = geometry ?? new BufferGeometry();
        this.mesh.visible = geometry !== null;
    }
}

export class TargetView extends MeshView {
    constructor(host: HTMLElement, label: string) {
        super(host, label, -0.15);
    }

    private places = new Float32Array();
    private placeNormals = new Float32Array();
    private paths: Polylines | null = null;
    private surface: Surface | null = null;

    setTarget(target: TargetInfo | null): void {
        this.viewer.frameOn(target?.positions ?? []);
    }

    /** Shows the patches of a result, or the bare target. */
    setSurface(
        target: TargetInfo | null,
        result: EmbedResult | null,
        layout: LayoutInfo | null,
    ): void {
        const theme = currentTheme();
        const refined = result?.refined;
        if (refined && layout) {
            this.surface = patchSurface(refined, patchColors(layout), theme.clay);
            this.material.vertexColors = true;
            this.material.color.set(0xffffff);
        } else {
            this.surface = target ? plainSurface(target.positions, target.corners) : null;
            this.material.vertexColors = false;
            this.material.color.set(theme.clay);
        }
        // A mesh with a boundary is seen from both sides.
        this.material.side = target && target.boundaryLoopCount > 0 ? DoubleSide : FrontSide;
        this.material.needsUpdate = true;
        this.setGeometry(this.surface?.geometry ?? null);
        this.viewer.requestRender();
    }

    setWireframe(on: boolean): void {
        this.material.wireframe = on;
        this.viewer.requestRender();
    }

    /** Call after setSurface(): the dots need its normals. */
    setLandmarks(target: TargetInfo | null, ids: Uint32Array | null): void {
        const count = target && ids ? ids.length : 0;
        this.places = new Float32Array(3 * count);
        this.placeNormals = new Float32Array(3 * count);
        ids?.forEach((v, i) => {
            if (!target) return;
            for (let c = 0; c < 3; ++c) {
                this.places[3 * i + c] = target.positions[3 * v + c]!;
                this.placeNormals[3 * i + c] = this.surface?.normals[3 * v + c] ?? 0;
            }
        });
        this.dots.setPlaces(this.places, this.placeNormals, this.viewer.radius);
        this.viewer.requestRender();
    }

    setPaths(result: EmbedResult | null, live: Polylines | null): void {
        this.paths = result?.refined ? chainPaths(result.edges, result.refined) : live;
        this.lines.setPaths(this.paths);
        this.viewer.requestRender();
    }

    protected pickable(): Pickable {
        return { places: this.places, placeNormals: this.placeNormals, paths: this.paths };
    }
}

export class LayoutView extends MeshView {
    constructor(host: HTMLElement, label: string) {
        // At a sharp corner one face is seen long after the mean normal has turned away.
        super(host, label, -0.6);
    }

    private places = new Float32Array();
    private placeNormals = new Float32Array();
    private paths: Polylines | null = null;

    setLayout(layout: LayoutInfo | null): void {
        this.material.vertexColors = true;
        this.material.flatShading = true;
        this.material.side = layout && layout.boundaryLoopCount > 0 ? DoubleSide : FrontSide;
        this.material.needsUpdate = true;
        this.setGeometry(layout ? layoutSurface(layout, patchColors(layout)) : null);
        this.viewer.frameOn(layout?.positions ?? []);
        this.places = new Float32Array(layout?.positions ?? []);
        this.placeNormals = layout
            ? vertexNormals(layout.positions, fans(layout))
            : new Float32Array();
        this.paths = layout ? straightEdges(layout) : null;
        this.lines.setPaths(this.paths);
        this.dots.setPlaces(this.places, this.placeNormals, this.viewer.radius);
        this.viewer.requestRender();
    }

    protected pickable(): Pickable {
        return { places: this.places, placeNormals: this.placeNormals, paths: this.paths };
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
