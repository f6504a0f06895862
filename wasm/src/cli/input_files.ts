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

/** What files of factors are about. */
const factorFiles = {
    vertexCosts: {
        file: "the file of vertex costs",
        owner: "the target",
        elements: ["vertex", "vertices"],
        says: "says that length costs",
    },
    edgeWeights: {
        file: "the file of edge weights",
        owner: "the layout",
        elements: ["edge", "edges"],
        says: "gives the weight",
    },
} as const;

/** A file with a number per line, one for each of `count` elements. */
export async function readFactors(
    kind: keyof typeof factorFiles,
    file: string,
    count: number,
): Promise<number[]> {
    const { elements, ...of } = factorFiles[kind];
    const { bytes, name } = await readInput(of.file, file);
    const words = new TextDecoder().decode(bytes).split(/\s+/).filter(Boolean);
    const factors = words.map(Number);
    const wrong = factors.findIndex((factor) => !(factor >= 0.001 && factor <= 1000));
    if (wrong >= 0) {
        throw new LayoutError(
            "invalidOption",
            `${name} ${of.says} ${words[wrong] ?? ""} at ${elements[0]} ${String(wrong)}; ` +
                "give numbers from 0.001 to 1000.",
        );
    }
    if (factors.length !== count) {
        throw new LayoutError(
            "invalidOption",
            `${name} has ${String(factors.length)} numbers, ${of.owner} ${String(count)} ` +
                `${elements[1]}; give one number per ${elements[0]}.`,
        );
    }
    return factors;
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
