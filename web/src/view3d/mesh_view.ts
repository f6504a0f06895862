import {
    BufferGeometry,
    DoubleSide,
    Mesh,
    MeshBasicMaterial,
    MeshLambertMaterial,
    type Plane,
    type Vector3,
} from "three";
import type { Polylines } from "layout-embedding";
import type { Item } from "../model/state.js";
import { currentTheme } from "./colors.js";
import { Dots, type Dot } from "./dots.js";
import { pick } from "./pick.js";
import { PathTubes } from "./tubes.js";
import { Viewer } from "./viewer.js";

/** What is under the pointer. */
export interface Sighting {
    readonly item: Item | null;
    /** The nearest target vertex without another landmark; null in the layout's view. */
    readonly vertex: number | null;
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
    protected readonly mesh = new Mesh(new BufferGeometry(), this.material);
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
        this.overlay.geometry.dispose();
        const geometry = item?.kind === "face" ? this.faceGeometry(item.id) : null;
        this.overlay.visible = geometry !== null;
        this.overlay.geometry = geometry ?? new BufferGeometry();
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
        const plane = this.viewer.cutPlane(share);
        const planes: Plane[] | null = plane ? [plane] : null;
        this.material.clippingPlanes = planes;
        this.material.side = planes ? DoubleSide : this.side();
        this.material.needsUpdate = true;
        this.overlay.material.clippingPlanes = planes;
        this.tubes.setClip(planes);
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
            },
            0.08 * radius,
            camera,
            canvas,
            x,
            y,
        );
        const item =
            found ?? (hit && hit.patch >= 0 ? ({ kind: "face", id: hit.patch } as const) : null);
        return { item, vertex: hit ? this.vertexAt(hit, dragged) : null };
    }

    protected abstract surfaceAt(x: number, y: number): ViewHit | null;
    protected abstract vertexAt(hit: ViewHit, dragged: number | null): number | null;
    protected abstract faceGeometry(face: number): BufferGeometry | null;
    /** Which sides of the surface are drawn while nothing is cut away. */
    protected abstract side(): 0 | 2;

    protected setGeometry(geometry: BufferGeometry | null): void {
        this.mesh.geometry.dispose();
        this.mesh.geometry = geometry ?? new BufferGeometry();
        this.mesh.visible = geometry !== null;
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
