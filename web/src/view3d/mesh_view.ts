import {
    BufferGeometry,
    DoubleSide,
    Mesh,
    type Material,
    MeshBasicMaterial,
    MeshLambertMaterial,
    type Plane,
    type Ray,
    type Vector3,
} from "three";
import type { Polylines } from "layout-embedding";
import type { Item } from "../model/state.js";
import { currentTheme } from "./colors.js";
import type { FacedSurface } from "./geometry.js";
import { Dots, type Dot } from "./dots.js";
import { pick } from "./pick.js";
import { PathTubes } from "./tubes.js";
import { Viewer } from "./viewer.js";

/** What is under the pointer. */
export interface Sighting {
    readonly item: Item | null;
    /** The nearest target vertex without another landmark; null in the layout's view. */
    readonly vertex: number | null;
    /** Where the surface is seen; null where it is not. */
    readonly hit: Pick<ViewHit, "face" | "point"> | null;
}

/** What a view tells of the pointer; who listens decides what it means. */
export interface ViewListener {
    hover(sighting: Sighting | null): void;
    click(sighting: Sighting): void;
    /** A dot is pulled; only where dots can be moved. */
    drag?(id: number, vertex: number): void;
    dragEnd?(): void;
}

/** Pixels that the pointer may move in a click. */
const clickReach = 5;

/** A viewer with a surface, paths on it and numbered dots: what both views have in common. */
export abstract class MeshView {
    readonly viewer: Viewer;
    protected readonly material = new MeshLambertMaterial({
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
    });
    protected readonly mesh: Mesh<BufferGeometry, Material> = new Mesh(
        new BufferGeometry(),
        this.material,
    );
    protected readonly overlay = new Mesh(
        new BufferGeometry(),
        new MeshBasicMaterial({
            transparent: true,
            opacity: 0.5,
            side: DoubleSide,
            depthWrite: false,
        }),
    );
    protected readonly tubes = new PathTubes();
    protected readonly dots: Dots;
    protected shownDots: readonly Dot[] = [];
    protected shownPaths: Polylines | null = null;
    /** Per face of the surface: its first corner; empty where there are no faces to be pointed at. */
    protected faceOffsets: Uint32Array = new Uint32Array();
    private markedFace: number | null = null;
    /** What lies on its negative side is cut away; null for nothing. */
    private cut: Plane | null = null;
    private hoverFrame = 0;
    private pressed: { x: number; y: number; dot: number | null } | null = null;
    private dragging = false;

    constructor(
        host: HTMLElement,
        label: string,
        private readonly horizon: number,
        private readonly listener: ViewListener,
    ) {
        this.dots = new Dots(horizon);
        this.viewer = new Viewer(host, label);
        this.mesh.visible = this.overlay.visible = false;
        this.overlay.renderOrder = 1;
        this.viewer.content.add(this.mesh, this.overlay, this.tubes.group, this.dots.points);
        this.listen(host);
    }

    applyTheme(): void {
        const theme = currentTheme();
        this.viewer.setBackground(theme.background);
        this.tubes.setTheme(theme);
        this.dots.setTheme(theme);
        this.overlay.material.color.set(theme.accent);
        this.viewer.requestRender();
    }

    /** Marks what the pointer is over, or what was chosen. */
    highlight(item: Item | null): void {
        this.tubes.highlight(item?.kind === "edge" ? item.id : null);
        this.dots.highlight(item?.kind === "vertex" ? item.id : null);
        this.markFace(item?.kind === "face" ? item.id : null);
        this.viewer.requestRender();
    }

    setWireframe(on: boolean): void {
        this.material.wireframe = on;
        this.viewer.requestRender();
    }

    setPathsVisible(on: boolean): void {
        this.tubes.group.visible = on;
        this.viewer.requestRender();
    }

    setDotsVisible(on: boolean): void {
        this.dots.shown = on;
        this.viewer.requestRender();
    }

    /** Cuts away a share of the front, as seen now. */
    setClip(share: number): void {
        this.cut = this.viewer.cutPlane(share);
        const planes = this.cut ? [this.cut] : null;
        this.material.clippingPlanes = planes;
        this.material.side = planes ? DoubleSide : this.side();
        this.material.needsUpdate = true;
        this.overlay.material.clippingPlanes = planes;
        this.tubes.setClip(planes);
        this.dots.setCut(this.cut);
        this.viewer.requestRender();
    }

    /** What is at a point of the canvas, in CSS pixels. */
    sight(x: number, y: number, dragged: number | null = null): Sighting {
        const hit = this.surfaceAt(x, y);
        const { canvas, camera, radius } = this.viewer;
        const found = pick(
            {
                dots: this.dots.shown ? this.shownDots : [],
                horizon: this.horizon,
                paths: this.tubes.group.visible ? this.shownPaths : null,
                surface: hit?.distance ?? Infinity,
                cut: this.cut,
            },
            0.08 * radius,
            camera,
            canvas,
            x,
            y,
        );
        const item =
            found ?? (hit && hit.patch >= 0 ? ({ kind: "face", id: hit.patch } as const) : null);
        return { item, vertex: hit ? this.vertexAt(hit, dragged) : null, hit };
    }

    /**
     * The line of sight through a point of the canvas, from where nothing is cut away on; `from` is
     * how far that is from the eye.
     */
    protected sightLine(x: number, y: number): { ray: Ray; from: number } | null {
        const ray = this.viewer.ray(x, y).clone();
        if (!this.cut || this.cut.distanceToPoint(ray.origin) >= 0) return { ray, from: 0 };
        const from = ray.distanceToPlane(this.cut);
        return from === null ? null : { ray: ray.recast(from), from };
    }

    protected abstract surfaceAt(x: number, y: number): ViewHit | null;
    protected abstract vertexAt(hit: ViewHit, dragged: number | null): number | null;
    /** Which sides of the surface are drawn while nothing is cut away. */
    protected abstract side(): 0 | 2;

    /** The surface to be drawn; its triangles are in the order of its faces, if it has any. */
    protected setSurfaceGeometry(surface: FacedSurface | BufferGeometry | null): void {
        const faced = surface !== null && "faceOffsets" in surface ? surface : null;
        const geometry = faced?.geometry ?? (surface as BufferGeometry | null);
        this.mesh.geometry.dispose();
        this.overlay.geometry.dispose();
        this.mesh.geometry = geometry ?? new BufferGeometry();
        this.mesh.visible = geometry !== null;
        this.faceOffsets = faced?.faceOffsets ?? new Uint32Array();
        // The same triangles again: a face is a range of them.
        const again = new BufferGeometry();
        if (faced) {
            again.setAttribute("position", faced.geometry.getAttribute("position"));
            again.setIndex(faced.geometry.getIndex());
        }
        this.overlay.geometry = again;
        this.markFace(this.markedFace);
    }

    private markFace(face: number | null): void {
        this.markedFace = face;
        const [begin, end] = face === null ? [] : this.faceOffsets.subarray(face, face + 2);
        this.overlay.visible = begin !== undefined && end !== undefined;
        if (begin !== undefined && end !== undefined)
            this.overlay.geometry.setDrawRange(begin, end - begin);
    }

    private listen(host: HTMLElement): void {
        const { canvas } = this.viewer;
        const { listener } = this;
        // On its way down, before the camera's own listeners: a press on a dot drags that dot.
        host.addEventListener(
            "pointerdown",
            (event) => {
                if (event.target !== canvas || event.button !== 0) return;
                const { item } = this.sight(event.offsetX, event.offsetY);
                const dot = listener.drag && item?.kind === "vertex" ? item.id : null;
                this.pressed = { x: event.offsetX, y: event.offsetY, dot };
                this.viewer.turning = dot === null;
                if (dot !== null) canvas.setPointerCapture(event.pointerId);
            },
            { capture: true },
        );
        canvas.addEventListener("pointermove", (event) => {
            if (event.buttons !== 0 && (this.pressed?.dot ?? null) === null) return;
            if (this.hoverFrame !== 0) return;
            const { offsetX, offsetY } = event;
            this.hoverFrame = requestAnimationFrame(() => {
                this.hoverFrame = 0;
                if ((this.pressed?.dot ?? null) !== null) this.dragTo(offsetX, offsetY);
                else listener.hover(this.sight(offsetX, offsetY));
            });
        });
        canvas.addEventListener("pointerup", (event) => {
            const { pressed } = this;
            this.endPress();
            if (!pressed) return;
            const moved = Math.hypot(event.offsetX - pressed.x, event.offsetY - pressed.y);
            if (moved > clickReach || event.button !== 0) return;
            listener.click(this.sight(event.offsetX, event.offsetY));
        });
        canvas.addEventListener("pointercancel", () => this.endPress());
        canvas.addEventListener("pointerleave", () => listener.hover(null));
    }

    private dragTo(x: number, y: number): void {
        const { pressed } = this;
        if (!pressed || pressed.dot === null) return;
        if (!this.dragging && Math.hypot(x - pressed.x, y - pressed.y) <= clickReach) return;
        this.dragging = true;
        const { vertex } = this.sight(x, y, pressed.dot);
        if (vertex !== null) this.listener.drag?.(pressed.dot, vertex);
    }

    private endPress(): void {
        if (this.dragging) this.listener.dragEnd?.();
        this.dragging = false;
        this.pressed = null;
        this.viewer.turning = true;
    }
}

/** Where the line of sight meets what a view shows. */
export interface ViewHit {
    readonly face: number;
    readonly point: Vector3;
    readonly distance: number;
    /** The layout face there; -1 where there is none. */
    readonly patch: number;
}
