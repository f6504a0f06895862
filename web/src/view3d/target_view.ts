import { Color, DoubleSide, FrontSide, Triangle, Vector3 } from "three";
import type {
    LayoutInfo,
    Polylines,
    QuadMesh,
    RefinedMesh,
    SurfaceMap,
    TargetInfo,
} from "layout-embedding";
import { placeOf, type FacePoint, type Side } from "../model/correspondence.js";
import type { Landmarks } from "../model/landmarks.js";
import { carriedMaterial, carriedSurface, type Carried } from "./carried_surface.js";
import { currentTheme, patchColors } from "./colors.js";
import { Dots, type Dot } from "./dots.js";
import { PatchFinder, patchSurface, plainSurface, trianglesOf, vertexNormals } from "./geometry.js";
import { MeshView, type Sighting, type ViewHit, type ViewListener } from "./mesh_view.js";
import { glide, sameEdges } from "./morph.js";
import { QuadLines } from "./quad_lines.js";
import { SurfacePicker } from "./surface_picker.js";

/** Beyond the numbers that dots may carry. */
const cursorId = 1034;

/** The target, with landmarks, paths and patches on it. */
export class TargetView extends MeshView {
    private target: TargetInfo | null = null;
    private normals = new Float32Array();
    private landmarks: Landmarks | null = null;
    private refined: RefinedMesh | null = null;
    private picker: SurfacePicker | null = null;
    private patches: PatchFinder | null = null;
    /** Where a landmark would go. */
    private readonly ghost = new Dots(-0.15, 0.7);
    private readonly lines = new QuadLines();
    /** A point that a map connects with another one: no landmark, and without a number. */
    private readonly cursor = new Dots(-0.15);
    private readonly carried = carriedMaterial();
    /** How far patches have faded into the bare target's colour. */
    private readonly fade = { value: 0 };
    private readonly bare = { value: new Color() };
    /** Told of what the pointer is over, or has been pressed on, besides the listener. */
    onSight: ((sighting: Sighting | null) => void) | null = null;
    private endGlide = () => {};

    constructor(host: HTMLElement, label: string, listener: ViewListener) {
        super(host, label, -0.15, {
            ...listener,
            hover: (sighting) => {
                listener.hover(sighting);
                this.onSight?.(sighting);
            },
            click: (sighting) => {
                listener.click(sighting);
                this.onSight?.(sighting);
            },
        });
        this.viewer.content.add(this.ghost.points, this.lines.group, this.cursor.points);
        this.cursor.highlight(cursorId);
        this.material.onBeforeCompile = (shader) => {
            Object.assign(shader.uniforms, { fade: this.fade, bare: this.bare });
            shader.fragmentShader = shader.fragmentShader
                .replace(
                    "#include <common>",
                    "#include <common>\nuniform float fade;\nuniform vec3 bare;",
                )
                .replace(
                    "#include <color_fragment>",
                    "#include <color_fragment>\ndiffuseColor.rgb = mix(diffuseColor.rgb, bare, fade);",
                );
        };
    }

    override applyTheme(): void {
        super.applyTheme();
        this.ghost.setTheme(currentTheme());
        this.lines.setTheme(currentTheme());
        this.cursor.setTheme(currentTheme());
        this.bare.value.set(currentTheme().clay);
    }

    setTarget(target: TargetInfo | null): void {
        this.target = target;
        this.normals = target
            ? vertexNormals(target.positions, target.corners)
            : new Float32Array();
        this.picker = target ? new SurfacePicker(target.positions, target.corners) : null;
        this.viewer.frameOn(target?.positions ?? []);
    }

    /**
     * Shows the patches of an embedding, or the bare target; or a quad mesh in its place, in the
     * colours of the patches if there is an embedding.
     */
    setSurface(
        refined: RefinedMesh | null,
        layout: LayoutInfo | null,
        quads: QuadMesh | null = null,
    ): void {
        const theme = currentTheme();
        const { target, material } = this;
        const patched = target !== null && refined !== null && layout !== null;
        this.refined = patched ? refined : null;
        this.patches = null;
        this.mesh.material = material;
        this.lines.setMesh(quads, layout?.edgeCount ?? 0);
        const drawn = quads ? trianglesOf(quads) : patched ? refined : null;
        if (drawn && layout) {
            this.setSurfaceGeometry(patchSurface(drawn, patchColors(layout), theme.clay));
            material.color.set(patched ? 0xffffff : theme.clay);
        } else {
            this.setSurfaceGeometry(target ? plainSurface(target, this.normals) : null);
            material.color.set(theme.clay);
        }
        material.vertexColors = patched;
        material.side = material.clippingPlanes ? DoubleSide : this.side();
        material.needsUpdate = true;
        this.viewer.requestRender();
    }

    /** Whether the patches are those of an earlier embedding. */
    setStale(stale: boolean): void {
        this.fade.value = stale ? 0.65 : 0;
        this.viewer.requestRender();
    }

    /** Shows what a map carries, in place of patches: on the target of one side of the map. */
    setCarried(map: SurfaceMap, side: Side, carried: Carried): void {
        if (!this.target) return;
        this.lines.setMesh(null, 0);
        this.setSurfaceGeometry(carriedSurface(map, side, this.target, this.normals, carried));
        this.carried.setTexture(carried.texture);
        this.mesh.material = this.carried.material;
        this.clipCarried();
        this.viewer.requestRender();
    }

    /** Shows a point of the target; null for none. */
    setCursor(point: FacePoint | null): void {
        const { target, normals } = this;
        const dots: Dot[] = [];
        if (target && point)
            dots.push({
                id: cursorId,
                place: placeOf(target, point),
                normal: placeOf({ positions: normals, corners: target.corners }, point),
                hollow: true,
            });
        // Somewhat smaller than landmarks.
        this.cursor.setDots(dots, this.viewer.radius, 50);
        this.viewer.requestRender();
    }

    setLandmarks(landmarks: Landmarks | null): void {
        this.landmarks = landmarks;
        const dots: Dot[] = [];
        landmarks?.places.forEach((vertex, id) => {
            if (vertex !== null) dots.push(this.dotOn(id, vertex));
        });
        this.shownDots = this.target ? dots : [];
        this.dots.setDots(this.shownDots, this.viewer.radius, landmarks?.places.length ?? 0);
        this.viewer.requestRender();
    }

    /** Shows where landmark `id` would go; null for nowhere. */
    setGhost(id: number, vertex: number | null): void {
        const dots = vertex === null ? [] : [this.dotOn(id, vertex)];
        this.ghost.setDots(dots, this.viewer.radius, this.landmarks?.places.length ?? 0);
        this.viewer.requestRender();
    }

    /** `detours` are drawn in the colour of what is longer than it need be. */
    setPaths(paths: Polylines | null, detours?: ReadonlySet<number>): void {
        this.endGlide();
        this.shownPaths = paths;
        this.tubes.setPaths(paths, detours);
        this.viewer.requestRender();
    }

    /** The same paths in another shape, which they glide into. */
    glideTo(paths: Polylines): void {
        this.endGlide();
        const from = this.shownPaths;
        if (!from || !sameEdges(from, paths)) {
            this.setPaths(paths);
            return;
        }
        this.shownPaths = paths;
        this.endGlide = glide(from, paths, (between) => {
            this.tubes.setPaths(between);
            this.viewer.requestRender();
        });
    }

    override setClip(share: number): void {
        super.setClip(share);
        this.lines.setClip(this.material.clippingPlanes);
        this.clipCarried();
    }

    override setWireframe(on: boolean): void {
        super.setWireframe(on);
        this.carried.material.wireframe = on;
    }

    /** Brings a target vertex into the middle of the view. */
    focusOn(vertex: number): void {
        if (!this.target) return;
        const at = (from: ArrayLike<number>) => new Vector3().fromArray(from, 3 * vertex);
        this.viewer.focusOn(at(this.target.positions), 0.4 * this.viewer.radius, at(this.normals));
    }

    /** The free vertex at the middle of the view; null where it shows none. */
    vertexInTheMiddle(): number | null {
        const { clientWidth, clientHeight } = this.viewer.canvas;
        return this.sight(clientWidth / 2, clientHeight / 2).vertex;
    }

    /** The neighbour of a vertex in a direction on the screen, y upwards; without a landmark. */
    neighbour(vertex: number, x: number, y: number, isFree = true): number | null {
        const direction = this.viewer.onScreen(x, y);
        const allowed = (v: number) => !isFree || this.isFree(v, null);
        return this.picker?.neighbourTowards(vertex, direction, allowed) ?? null;
    }

    /** A point of a face in its barycentric coordinates. */
    pointAt({ face, point }: Pick<ViewHit, "face" | "point">): FacePoint | null {
        if (!this.target) return null;
        const { positions, corners } = this.target;
        const [a, b, c] = [0, 1, 2].map((k) =>
            new Vector3().fromArray(positions, 3 * corners[3 * face + k]!),
        ) as [Vector3, Vector3, Vector3];
        const weights = Triangle.getBarycoord(point, a, b, c, new Vector3());
        return weights && { face, weights: weights.toArray() };
    }

    protected override surfaceAt(x: number, y: number): ViewHit | null {
        const line = this.sightLine(x, y);
        const seen = line && this.picker?.hit(line.ray);
        if (!seen || !this.target) return null;
        const hit = { ...seen, distance: seen.distance + line.from };
        if (!this.refined) return { ...hit, patch: -1 };
        this.patches ??= new PatchFinder(this.refined, this.target.faceCount);
        return { ...hit, patch: this.patches.at(hit.face, hit.point) };
    }

    protected override vertexAt(hit: ViewHit, dragged: number | null): number | null {
        return this.picker?.nearestCorner(hit, (vertex) => this.isFree(vertex, dragged)) ?? null;
    }

    protected override side(): 0 | 2 {
        // A mesh with a boundary is seen from both sides.
        return (this.target?.boundaryLoopCount ?? 0) > 0 ? DoubleSide : FrontSide;
    }

    private clipCarried(): void {
        const { material } = this.carried;
        material.clippingPlanes = this.material.clippingPlanes;
        material.side = this.material.side;
        material.needsUpdate = true;
    }

    private isFree(vertex: number, except: number | null): boolean {
        return this.landmarks?.places.every((v, id) => v !== vertex || id === except) ?? true;
    }

    private dotOn(id: number, vertex: number): Dot {
        const { target, normals } = this;
        const three = (from: ArrayLike<number>) =>
            new Vector3().fromArray(from, 3 * vertex).toArray();
        const place = target ? three(target.positions) : [0, 0, 0];
        return { id, place, normal: three(normals), hollow: false };
    }
}
