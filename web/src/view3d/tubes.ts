import {
    BufferAttribute,
    BufferGeometry,
    Color,
    Group,
    Mesh,
    MeshLambertMaterial,
    Vector2,
    Vector3,
    type Plane,
} from "three";
import type { Polylines } from "layout-embedding";
import type { ViewTheme } from "./colors.js";

/** Radii in CSS pixels, whatever the distance. */
const inkRadius = 1.7;
const markRadius = 3.1;
const sides = 8;
/** Of the corners of a ring. */
const directions = Array.from({ length: sides }, (_, side) => ({
    cos: Math.cos((2 * Math.PI * side) / sides),
    sin: Math.sin((2 * Math.PI * side) / sides),
}));

/**
 * Paths as round tubes around their polylines. Half of a tube stands out of the surface that its
 * path lies in, so nothing flickers and nothing is hidden; the vertex shader gives it its width on
 * the screen.
 */
export class PathTubes {
    readonly group = new Group();
    private readonly ink = tubeMaterial(inkRadius);
    private readonly mark = tubeMaterial(markRadius);
    private readonly warn = tubeMaterial(inkRadius * 1.35);
    private paths: Polylines | null = null;
    private marked: number | null = null;

    setTheme(theme: ViewTheme): void {
        this.ink.material.color.set(theme.ink);
        this.mark.material.color.set(theme.accent);
        this.warn.material.color.set(theme.warn);
    }

    /** Paths to draw; those of `detours` in the colour for what is longer than it need be. */
    setPaths(paths: Polylines | null, detours: ReadonlySet<number> = new Set()): void {
        this.clear();
        this.paths = paths;
        if (paths && paths.points.length > 0) {
            this.add(this.ink, (edge) => !detours.has(edge));
            this.add(this.warn, (edge) => detours.has(edge));
        }
        this.addMark();
    }

    /** Highlights the path of one layout edge; null for none. */
    highlight(layoutEdge: number | null): void {
        if (layoutEdge === this.marked) return;
        this.marked = layoutEdge;
        for (const child of [...this.group.children])
            if (child instanceof Mesh && child.material === this.mark.material) {
                child.removeFromParent();
                (child.geometry as BufferGeometry).dispose();
            }
        this.addMark();
    }

    setClip(planes: Plane[] | null): void {
        for (const { material } of [this.ink, this.mark, this.warn]) {
            material.clippingPlanes = planes;
            material.needsUpdate = true;
        }
    }

    private addMark(): void {
        const { marked } = this;
        if (marked !== null && this.paths) this.add(this.mark, (edge) => edge === marked);
    }

    private add(look: TubeLook, chosen: (layoutEdge: number) => boolean): void {
        if (!this.paths) return;
        const geometry = tubes(this.paths, chosen);
        if (!geometry) return;
        const mesh = new Mesh(geometry, look.material);
        mesh.frustumCulled = false;
        mesh.onBeforeRender = (renderer, _scene, camera) => {
            const size = renderer.getSize(new Vector2());
            // Half the height of the view, in lengths at distance 1, over half its height in pixels.
            look.width.value = look.radius / (camera.projectionMatrix.elements[5] * (size.y / 2));
        };
        this.group.add(mesh);
    }

    private clear(): void {
        for (const child of [...this.group.children])
            if (child instanceof Mesh) (child.geometry as BufferGeometry).dispose();
        this.group.clear();
    }
}

interface TubeLook {
    readonly material: MeshLambertMaterial;
    readonly radius: number;
    /** Lengths at distance 1 that make `radius` pixels. */
    readonly width: { value: number };
}

function tubeMaterial(radius: number): TubeLook {
    const width = { value: 0 };
    const material = new MeshLambertMaterial({ color: new Color() });
    material.onBeforeCompile = (shader) => {
        shader.uniforms["tubeWidth"] = width;
        shader.vertexShader = shader.vertexShader
            .replace("#include <common>", "#include <common>\nuniform float tubeWidth;")
            .replace(
                "#include <begin_vertex>",
                `vec3 transformed = position;
                float tubeDepth = max(0.0, -(modelViewMatrix * vec4(position, 1.0)).z);
                transformed += normal * tubeWidth * tubeDepth;`,
            );
    };
    material.customProgramCacheKey = () => "tube";
    return { material, radius, width };
}

/** Rings around the points of the chosen paths; a vertex's normal is its direction off the path. */
function tubes(paths: Polylines, chosen: (layoutEdge: number) => boolean): BufferGeometry | null {
    const lines: [number, number][] = [];
    let ringCount = 0;
    for (let p = 0; p + 1 < paths.offsets.length; ++p) {
        const [begin, end] = [paths.offsets[p]!, paths.offsets[p + 1]!];
        if (end - begin < 2 || !chosen(paths.layoutEdges[p]!)) continue;
        lines.push([begin, end]);
        ringCount += end - begin;
    }
    if (ringCount === 0) return null;
    const position = new Float32Array(3 * sides * ringCount);
    const normal = new Float32Array(3 * sides * ringCount);
    const index = new Uint32Array(6 * sides * (ringCount - lines.length));
    const at = (i: number, into: Vector3) =>
        into.set(paths.points[3 * i]!, paths.points[3 * i + 1]!, paths.points[3 * i + 2]);
    const [before, here, after] = [new Vector3(), new Vector3(), new Vector3()];
    const [tangent, u, v, out] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()];
    let vertex = 0;
    let corner = 0;
    for (const [begin, end] of lines) {
        u.set(0, 0, 0);
        for (let i = begin; i < end; ++i) {
            at(i, here);
            at(Math.max(begin, i - 1), before);
            at(Math.min(end - 1, i + 1), after);
            // The mean of both directions, so that short segments count as much as long ones.
            tangent.subVectors(here, before).normalize();
            tangent.add(out.subVectors(after, here).normalize());
            if (tangent.lengthSq() < 1e-12) tangent.subVectors(after, here);
            if (tangent.lengthSq() < 1e-24) tangent.set(1, 0, 0);
            tangent.normalize();
            // The frame is carried along, so that the tube does not twist.
            u.addScaledVector(tangent, -u.dot(tangent));
            if (u.lengthSq() < 1e-8)
                u.set(
                    Math.abs(tangent.x) < 0.8 ? 1 : 0,
                    Math.abs(tangent.x) < 0.8 ? 0 : 1,
                    0,
                ).cross(tangent);
            u.normalize();
            v.crossVectors(tangent, u);
            for (let side = 0; side < sides; ++side) {
                const { cos, sin } = directions[side]!;
                position[3 * vertex] = here.x;
                position[3 * vertex + 1] = here.y;
                position[3 * vertex + 2] = here.z;
                normal[3 * vertex] = cos * u.x + sin * v.x;
                normal[3 * vertex + 1] = cos * u.y + sin * v.y;
                normal[3 * vertex + 2] = cos * u.z + sin * v.z;
                if (i + 1 < end) {
                    const b = vertex - side + ((side + 1) % sides);
                    index[corner] = vertex;
                    index[corner + 1] = index[corner + 3] = b;
                    index[corner + 2] = index[corner + 5] = vertex + sides;
                    index[corner + 4] = b + sides;
                    corner += 6;
                }
                ++vertex;
            }
        }
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(position, 3));
    geometry.setAttribute("normal", new BufferAttribute(normal, 3));
    geometry.setIndex(new BufferAttribute(index, 1));
    return geometry;
}
