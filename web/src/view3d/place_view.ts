import {
    BufferAttribute,
    BufferGeometry,
    DoubleSide,
    LineBasicMaterial,
    LineSegments,
    Mesh,
    MeshLambertMaterial,
    Points,
    PointsMaterial,
    Sphere,
    Vector3,
} from "three";
import type { UncheckedMesh } from "layout-embedding";
import { currentTheme } from "./colors.js";
import { Viewer } from "./viewer.js";

/** What of a mesh is marked. */
export interface Marked {
    readonly mesh: UncheckedMesh;
    readonly vertices: readonly number[];
    readonly faces: readonly number[];
}

/** Edges of the faces around the place are drawn, of this many at most. */
const maximumNeighbours = 4000;

/** A mesh that was refused, with the place of the error in its middle. */
export class PlaceView {
    readonly viewer: Viewer;
    private readonly clay = new MeshLambertMaterial({
        side: DoubleSide,
        flatShading: true,
        polygonOffset: true,
        polygonOffsetFactor: 2,
        polygonOffsetUnits: 2,
    });
    private readonly mark = new MeshLambertMaterial({
        side: DoubleSide,
        flatShading: true,
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
    });
    private readonly lines = new LineBasicMaterial();
    private readonly dots = new PointsMaterial({
        size: 11,
        sizeAttenuation: false,
        depthTest: false,
    });

    constructor(host: HTMLElement, label: string) {
        this.viewer = new Viewer(host, label);
        this.applyTheme();
    }

    applyTheme(): void {
        const theme = currentTheme();
        this.viewer.setBackground(theme.background);
        this.clay.color.set(theme.clay);
        this.mark.color.set(theme.warn);
        this.lines.color.set(theme.ink);
        this.dots.color.set(theme.accent);
        this.viewer.requestRender();
    }

    show({ mesh, vertices, faces }: Marked): void {
        const { content } = this.viewer;
        for (const child of [...content.children])
            if ("geometry" in child) (child.geometry as BufferGeometry).dispose();
        content.clear();
        const positions = finitePositions(mesh);
        const marked = new Set(faces);
        const around = neighbours(mesh, vertices, faces);
        const all = Array.from({ length: mesh.offsets.length - 1 }, (_, f) => f);
        content.add(
            new Mesh(
                surface(
                    mesh,
                    positions,
                    all.filter((f) => !marked.has(f)),
                ),
                this.clay,
            ),
            new Mesh(surface(mesh, positions, faces), this.mark),
            new LineSegments(outlines(mesh, positions, around), this.lines),
        );
        const points = new Points(
            withPositions(vertices.flatMap((v) => [...positions.subarray(3 * v, 3 * v + 3)])),
            this.dots,
        );
        points.renderOrder = 2;
        content.add(points);

        this.viewer.frameOn(positions);
        const place = new Sphere().setFromPoints(
            [...vertices, ...around.flatMap((f) => cornersOf(mesh, f))].map((v) =>
                new Vector3().fromArray(positions, 3 * v),
            ),
        );
        // A vertex that has no faces is seen with a good part of the mesh.
        const radius = place.radius > 0 ? 2.5 * place.radius : 0.5 * this.viewer.radius;
        this.viewer.focusOn(place.center, radius, facing(mesh, positions, around));
    }
}

const cornersOf = ({ corners, offsets }: UncheckedMesh, face: number): number[] => [
    ...corners.subarray(offsets[face], offsets[face + 1]),
];

/** Coordinates that are no numbers are drawn at the origin: there is no better place. */
function finitePositions({ positions }: UncheckedMesh): Float32Array<ArrayBuffer> {
    return Float32Array.from(positions, (x) => (Math.abs(x) < 1e30 ? x : 0));
}

/** The marked faces and those at the marked vertices. */
function neighbours(
    mesh: UncheckedMesh,
    vertices: readonly number[],
    faces: readonly number[],
): number[] {
    const found = [...faces];
    const wanted = new Set(vertices);
    for (let f = 0; f + 1 < mesh.offsets.length && found.length < maximumNeighbours; ++f)
        if (!faces.includes(f) && cornersOf(mesh, f).some((v) => wanted.has(v))) found.push(f);
    return found;
}

function withPositions(positions: ArrayLike<number>): BufferGeometry {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
    return geometry;
}

/** Faces as fans of triangles. */
function surface(
    { corners, offsets }: UncheckedMesh,
    positions: Float32Array<ArrayBuffer>,
    faces: readonly number[],
): BufferGeometry {
    const index: number[] = [];
    for (const f of faces)
        for (let i = offsets[f]! + 1; i + 1 < offsets[f + 1]!; ++i)
            index.push(corners[offsets[f]!]!, corners[i]!, corners[i + 1]!);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(positions, 3));
    geometry.setIndex(new BufferAttribute(Uint32Array.from(index), 1));
    geometry.computeVertexNormals();
    return geometry;
}

function outlines(
    mesh: UncheckedMesh,
    positions: Float32Array,
    faces: readonly number[],
): BufferGeometry {
    const points: number[] = [];
    for (const f of faces) {
        const face = cornersOf(mesh, f);
        face.forEach((v, i) => {
            const w = face[(i + 1) % face.length]!;
            points.push(...positions.subarray(3 * v, 3 * v + 3));
            points.push(...positions.subarray(3 * w, 3 * w + 3));
        });
    }
    return withPositions(points);
}

/** The side from which some faces are seen best: the mean of their normals. */
function facing(mesh: UncheckedMesh, positions: Float32Array, faces: readonly number[]): Vector3 {
    const sum = new Vector3();
    const at = (v: number) => new Vector3().fromArray(positions, 3 * v);
    for (const f of faces) {
        const [first, ...others] = cornersOf(mesh, f).map(at);
        for (let i = 0; first && i + 1 < others.length; ++i)
            sum.add(
                new Vector3().crossVectors(
                    others[i]!.clone().sub(first),
                    others[i + 1]!.clone().sub(first),
                ),
            );
    }
    return sum.normalize();
}
