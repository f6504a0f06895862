// Input files, with failures as sentences.
import { readFile } from "node:fs/promises";
import path from "node:path";
import { readReferenceInput } from "../formats.js";
import { javaScriptError, LayoutError } from "../errors.js";

/** A file's content and name, as the session takes them. `what` begins the messages. */
export async function readInput(
    what: string,
    file: string,
): Promise<{ bytes: Uint8Array; name: string }> {
    try {
        return { bytes: await readFile(file), name: path.basename(file) };
    } catch (reason) {
        throw fileError(what, file, reason);
    }
}

/** An `.inp` file: the paths of layout and target, and the landmarks. */
export async function readReference(file: string): Promise<{
    layout: string;
    target: string;
    landmarks: (vertexCount: number) => Uint32Array;
}> {
    const { bytes, name } = await readInput("the file", file);
    const { layoutFile, targetFile, landmarks } = await readReferenceInput(bytes, name);
    const folder = path.dirname(file);
    return {
        layout: path.resolve(folder, layoutFile),
        target: path.resolve(folder, targetFile),
        landmarks,
    };
}

/** A file with a number per line, one for each of `count` vertices. */
export async function readVertexCosts(file: string, count: number): Promise<number[]> {
    const { bytes, name } = await readInput("the file of vertex costs", file);
    const words = new TextDecoder().decode(bytes).split(/\s+/).filter(Boolean);
    const costs = words.map(Number);
    const wrong = costs.findIndex((cost) => !(cost >= 0.001 && cost <= 1000));
    if (wrong >= 0) {
        throw new LayoutError(
            "invalidOption",
            `${name} says that length costs ${words[wrong] ?? ""} at vertex ${String(wrong)}; ` +
                "give numbers from 0.001 to 1000.",
        );
    }
    if (costs.length !== count) {
        throw new LayoutError(
            "invalidOption",
            `${name} has ${String(costs.length)} numbers, the target ${String(count)} vertices; ` +
                "give one number per vertex.",
        );
    }
    return costs;
}

/** The error of a file that could not be read. */
export function fileError(what: string, file: string, reason: unknown): LayoutError {
    const code = (reason as { code?: string }).code ?? "";
    if (code === "ENOENT" || code === "ENOTDIR") {
        return javaScriptError("fileNotFound", `${what} ${file} does not exist`);
    }
    const causes: Record<string, string> = {
        EISDIR: "is a folder",
        EACCES: "may not be read",
        EPERM: "may not be read",
        ERR_FS_FILE_TOO_LARGE: "is larger than 2 GB",
    };
    return javaScriptError(
        "fileUnreadable",
        `${what} ${file} ${causes[code] ?? `fails (${code})`}`,
    );
}
