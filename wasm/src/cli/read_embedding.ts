// Reads back the three files that embed wrote (their formats: src/files.ts). Nothing in them is
// trusted: what has not the right shape is refused as damagedOutput.
import { readFile } from "node:fs/promises";
import path from "node:path";
import { Core } from "../core.js";
import { javaScriptError, LayoutError } from "../errors.js";
import { fileVersion, type EmbeddingDocument, type RefinedMapDocument } from "../files.js";
import { arraysOf, readFile as readMeshFile } from "../mesh.js";
import type { RefinedMesh } from "../types.js";
import { Shape } from "./shape.js";

/** What is checked of embedding.json. */
export type CheckedDocument = Pick<
    EmbeddingDocument,
    "cost" | "lowerBound" | "gap" | "status" | "metric" | "landmarks"
> & {
    edges: Pick<
        EmbeddingDocument["edges"][number],
        "id" | "layoutEdge" | "chain" | "length" | "weakPath"
    >[];
};

export interface WrittenEmbedding {
    document: CheckedDocument;
    refined: RefinedMesh;
    /** The `l` lines of refined.obj, as vertex ids. */
    lines: number[][];
}

/** embedding.json alone. */
export async function readDocument(folder: string) {
    return embedding(await readJson(folder, "embedding.json"));
}

export async function readEmbedding(folder: string): Promise<WrittenEmbedding> {
    const document = await readDocument(folder);
    const map = refinedMap(await readJson(folder, "refined_map.json"));
    const obj = await readOutput(folder, "refined.obj");
    const { positions, corners, offsets } = await readObj(obj);
    const triangleCount = offsets.length - 1;
    if (corners.length !== 3 * triangleCount) {
        throw damaged("refined.obj has a face that is not a triangle");
    }
    if (map.triangleFaces.length !== triangleCount || document.patches.length !== triangleCount) {
        throw damaged("refined.obj, refined_map.json and embedding.json differ in their triangles");
    }
    if (positions.length / 3 !== map.targetVertexCount + map.newVertices.length) {
        throw damaged("refined.obj and refined_map.json differ in their vertices");
    }
    const { groups, lines } = readGroupsAndLines(obj);
    const patches = Int32Array.from(document.patches, (patch) => patch ?? -1);
    const wrong = patches.findIndex((patch, triangle) => groups[triangle] !== patch);
    if (wrong >= 0) {
        throw damaged(`triangle ${String(wrong)} has another patch in refined.obj than in JSON`);
    }
    return {
        document,
        lines,
        refined: {
            positions,
            corners,
            patches,
            triangleFaces: Uint32Array.from(map.triangleFaces),
            vertexFaces: Uint32Array.from(map.newVertices, (vertex) => vertex.face),
            vertexBarycentrics: Float64Array.from(
                map.newVertices.flatMap((vertex) => vertex.barycentric),
            ),
        },
    };
}

function embedding(value: unknown): CheckedDocument & Pick<EmbeddingDocument, "patches"> {
    const root = new Shape(value, "embedding.json", damaged);
    root.get("version").exactly(fileVersion);
    const edges = root.get("edges").list((edge) => ({
        id: edge.get("id").id(),
        layoutEdge: edge.get("layoutEdge").tuple(2, (end) => end.id()) as [number, number],
        chain: edge.get("chain").list((vertex) => vertex.id()),
        length: edge.get("length").number(),
        weakPath: edge.get("weakPath").list((point) => point.listOf(1, 3, (vertex) => vertex.id())),
    }));
    if (edges.length === 0) {
        throw damaged("embedding.json holds no embedding");
    }
    const metric = root.get("metric");
    const factors = (name: string) =>
        metric.get(name).nullOr(() => metric.get(name).list((factor) => factor.number()));
    return {
        cost: root.get("cost").number(),
        lowerBound: root.get("lowerBound").number(),
        gap: root.get("gap").number(),
        status: root.get("status").text(),
        metric: {
            vertexCosts: factors("vertexCosts"),
            featureDiscount: metric.get("featureDiscount").number(),
            edgeWeights: factors("edgeWeights"),
        },
        landmarks: root.get("landmarks").list((landmark) => landmark.id()),
        patches: root.get("patches").list((patch) => patch.nullOr(() => patch.id())),
        edges,
    };
}

function refinedMap(value: unknown): RefinedMapDocument {
    const root = new Shape(value, "refined_map.json", damaged);
    return {
        version: root.get("version").exactly(fileVersion),
        targetVertexCount: root.get("targetVertexCount").id(),
        newVertices: root.get("newVertices").list((vertex) => ({
            face: vertex.get("face").id(),
            barycentric: vertex.get("barycentric").tuple(3, (coordinate) => coordinate.number()),
        })),
        triangleFaces: root.get("triangleFaces").list((face) => face.id()),
    };
}

async function readJson(folder: string, name: string): Promise<unknown> {
    const bytes = await readOutput(folder, name);
    try {
        return JSON.parse(new TextDecoder().decode(bytes)) as unknown;
    } catch {
        throw damaged(`${name} is no JSON`);
    }
}

async function readOutput(folder: string, name: string): Promise<Uint8Array> {
    try {
        return await readFile(path.join(folder, name));
    } catch {
        throw damaged(`${name} is missing in ${folder}, or cannot be read`);
    }
}

async function readObj(bytes: Uint8Array) {
    const core = await Core.create();
    try {
        const mesh = readMeshFile(core, "the mesh refined.obj", { bytes, format: "obj" });
        return arraysOf(core, mesh);
    } catch (reason) {
        throw reason instanceof LayoutError
            ? damaged(reason.message.replace(/[.;].*$/s, ""))
            : reason;
    }
}

/** What the core's reader skips: the patch of each face (-1 outside all of them) and the lines. */
function readGroupsAndLines(obj: Uint8Array): { groups: number[]; lines: number[][] } {
    const groups: number[] = [];
    const lines: number[][] = [];
    let patch = -1;
    for (const line of new TextDecoder().decode(obj).split("\n")) {
        if (line.startsWith("g ")) {
            const match = /^g patch_(\d+)(?:\s|$)/.exec(line);
            patch = match === null ? -1 : Number(match[1]);
        } else if (line.startsWith("f ")) {
            groups.push(patch);
        } else if (line.startsWith("l ")) {
            lines.push(
                line
                    .slice(2)
                    .trim()
                    .split(/\s+/)
                    .map((id) => Number(id) - 1),
            );
        }
    }
    return { groups, lines };
}

function damaged(what: string): LayoutError {
    return javaScriptError("damagedOutput", what);
}
