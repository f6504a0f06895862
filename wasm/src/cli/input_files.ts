// Input files, with failures as sentences.
import { readFile } from "node:fs/promises";
import path from "node:path";
import { javaScriptError, type LayoutError } from "../errors.js";

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
