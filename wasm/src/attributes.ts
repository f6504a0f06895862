// What an OBJ file says of its vertices and faces besides their places, carried over to the refined
// mesh: texture coordinates, vertex colours, groups, materials.
import type { MeshFile, RefinedMesh } from "./types.js";

export interface MeshAttributes {
    /** 3 vertex ids per triangle, as in the file. */
    corners: Uint32Array;
    /** 6 per triangle, two for each corner; null where not every corner has some. */
    textureCoordinates: Float64Array | null;
    /** 3 per vertex, as in `v x y z r g b`; null where not every vertex has some. */
    colours: Float64Array | null;
    /** Per triangle, "" for none; null where there are none. */
    groups: string[] | null;
    /** The same of materials. */
    materials: string[] | null;
    /** The files that materials are in. */
    materialFiles: string[];
}

/** The attributes of an OBJ file of triangles; null where it has none or is another file. */
export function meshAttributes({ bytes, name = "", format }: MeshFile): MeshAttributes | null {
    if (format === undefined ? !/\.obj$/i.test(name) : format !== "obj") {
        return null;
    }
    const places: number[] = [];
    const colours: number[] = [];
    const corners: number[] = [];
    const texture: number[] = [];
    const groups: string[] = [];
    const materials: string[] = [];
    const materialFiles: string[] = [];
    let group = "";
    let material = "";
    let vertexCount = 0;
    let isTriangles = true;
    for (const line of linesOf(new TextDecoder().decode(bytes))) {
        const [keyword, ...words] = line.trim().split(/\s+/);
        switch (keyword) {
            case "v":
                ++vertexCount;
                if (words.length >= 6) {
                    colours.push(...words.slice(3, 6).map(Number));
                }
                break;
            case "vt":
                places.push(Number(words[0]), Number(words[1] ?? 0));
                break;
            case "f":
                isTriangles &&= words.length === 3;
                groups.push(group);
                materials.push(material);
                for (const word of words) {
                    const [vertex = "", place = ""] = word.split("/");
                    corners.push(indexOf(vertex, vertexCount));
                    const id = place === "" ? -1 : indexOf(place, places.length / 2);
                    texture.push(places[2 * id] ?? NaN, places[2 * id + 1] ?? NaN);
                }
                break;
            case "g":
                group = words.join(" ");
                break;
            case "usemtl":
                material = words.join(" ");
                break;
            case "mtllib":
                materialFiles.push(words.join(" "));
                break;
            default:
        }
    }
    const attributes = {
        corners: Uint32Array.from(corners),
        textureCoordinates: texture.some(Number.isNaN) ? null : Float64Array.from(texture),
        colours:
            colours.length === 3 * vertexCount && !colours.some(Number.isNaN)
                ? Float64Array.from(colours)
                : null,
        groups: groups.every((one) => one === "") ? null : groups,
        materials: materials.every((one) => one === "") ? null : materials,
        materialFiles,
    };
    const { textureCoordinates, colours: ofVertices } = attributes;
    const isEmpty = [textureCoordinates, ofVertices, attributes.groups, attributes.materials].every(
        (one) => one === null,
    );
    return isTriangles && corners.length > 0 && !isEmpty ? attributes : null;
}

/** 0-based; the file counts from 1, or back from the last one. */
function indexOf(word: string, count: number): number {
    const given = Number(word);
    return given < 0 ? count + given : given - 1;
}

function* linesOf(text: string): Generator<string> {
    for (let begin = 0; begin < text.length;) {
        const newline = text.indexOf("\n", begin);
        const end = newline < 0 ? text.length : newline;
        yield text.slice(begin, end);
        begin = end + 1;
    }
}

/**
 * `obj`, which is what the core wrote of a refined mesh, with the attributes of its target: new
 * vertices lie in the target's triangles and have what lies between their corners there. Groups
 * stand behind the patch's name, as further groups of its faces.
 */
export function withAttributes(
    obj: Uint8Array,
    refined: RefinedMesh,
    attributes: MeshAttributes,
): Uint8Array {
    const { colours, textureCoordinates, groups, materials, materialFiles } = attributes;
    const place = new PlaceOnTarget(refined, attributes.corners);
    const lines = materialFiles.map((file) => `mtllib ${file}`);
    const textureIds = new Map<string, number>();
    let vertex = 0;
    let triangle = 0;
    let patch = "";
    let group = "";
    let material = "";
    for (const line of linesOf(new TextDecoder().decode(obj))) {
        if (line.startsWith("v ")) {
            lines.push(
                colours === null
                    ? line
                    : `${line} ${place.mixed(vertex, (id, axis) => colours[3 * id + axis] ?? 0, 3).join(" ")}`,
            );
            ++vertex;
        } else if (line.startsWith("g ")) {
            patch = line;
            group = "";
            lines.push(line);
        } else if (line.startsWith("f ")) {
            const face = refined.triangleFaces[triangle] ?? 0;
            const newGroup = groups?.[face] ?? "";
            if (newGroup !== group) {
                group = newGroup;
                lines.push(`${patch} ${group}`.trimEnd());
            }
            const newMaterial = materials?.[face] ?? "";
            if (newMaterial !== material) {
                material = newMaterial;
                lines.push(`usemtl ${material}`.trimEnd());
            }
            if (textureCoordinates === null) {
                lines.push(line);
            } else {
                const words = [0, 1, 2].map((k) => {
                    const id = refined.corners[3 * triangle + k] ?? 0;
                    const weights = place.inFace(id, face);
                    const [u, v] = [0, 1].map((axis) =>
                        weights.reduce(
                            (sum, weight, corner) =>
                                sum +
                                weight * (textureCoordinates[6 * face + 2 * corner + axis] ?? 0),
                            0,
                        ),
                    );
                    const text = `vt ${String(u)} ${String(v)}`;
                    let textureId = textureIds.get(text);
                    if (textureId === undefined) {
                        textureId = textureIds.size + 1;
                        textureIds.set(text, textureId);
                        lines.push(text);
                    }
                    return `${String(id + 1)}/${String(textureId)}`;
                });
                lines.push(`f ${words.join(" ")}`);
            }
            ++triangle;
        } else {
            lines.push(line);
        }
    }
    return new TextEncoder().encode([...lines, ""].join("\n"));
}

/** Where the vertices of a refined mesh lie on the target. */
class PlaceOnTarget {
    private readonly targetVertices: number;

    /** `corners`: 3 vertex ids per target face. */
    constructor(
        private readonly refined: RefinedMesh,
        private readonly corners: Uint32Array,
    ) {
        this.targetVertices = refined.positions.length / 3 - refined.vertexFaces.length;
    }

    /** The weights of the corners of a target face that a vertex lies in or on the rim of. */
    inFace(vertex: number, face: number): number[] {
        const corners = this.corners.subarray(3 * face, 3 * face + 3);
        const weights = this.ofVertex(vertex);
        return Array.from(corners, (corner) => weights.get(corner) ?? 0);
    }

    /** What vertices have, by id and axis, at a vertex of the refined mesh. */
    mixed(vertex: number, value: (id: number, axis: number) => number, axes: number): number[] {
        const weights = this.ofVertex(vertex);
        return Array.from({ length: axes }, (_, axis) => {
            let sum = 0;
            for (const [id, weight] of weights) {
                sum += weight * value(id, axis);
            }
            return sum;
        });
    }

    /** Weights of target vertices. */
    private ofVertex(vertex: number): Map<number, number> {
        if (vertex < this.targetVertices) {
            return new Map([[vertex, 1]]);
        }
        const k = vertex - this.targetVertices;
        const face = this.refined.vertexFaces[k] ?? 0;
        return new Map(
            [0, 1, 2].map((corner) => [
                this.corners[3 * face + corner] ?? 0,
                this.refined.vertexBarycentrics[3 * k + corner] ?? 0,
            ]),
        );
    }
}
