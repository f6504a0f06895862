// The folder that results are written to. It is made and tried before the work begins, so that
// nobody waits for a result that cannot be kept.
import { access, constants, mkdir, rename, rm, rmdir, stat, writeFile } from "node:fs/promises";
import path from "node:path";
import { javaScriptError, type LayoutError } from "../errors.js";

export class OutputFolder {
    private constructor(
        readonly folder: string,
        /** The topmost folder that had to be made; undefined if all were there. */
        private readonly made: string | undefined,
    ) {}

    /** Makes the folder where needed; throws outputFailed where nothing can be written to it. */
    static async prepare(folder: string): Promise<OutputFolder> {
        try {
            const made = await mkdir(folder, { recursive: true });
            await access(folder, constants.W_OK | constants.X_OK);
            return new OutputFolder(folder, made);
        } catch (reason) {
            const isFile = await stat(folder).then(
                (there) => !there.isDirectory(),
                () => false,
            );
            throw isFile
                ? javaScriptError("outputFailed", `the output folder ${folder} is a file`)
                : outputError(`the output folder ${folder} cannot be written to`, reason);
        }
    }

    /** Writes all files or, but for a crash in between, none; their paths. */
    async write(files: Record<string, Uint8Array>): Promise<string[]> {
        const written: [string, string][] = [];
        try {
            for (const [name, bytes] of Object.entries(files)) {
                const final = path.join(this.folder, name);
                const draft = `${final}.part`;
                written.push([draft, final]);
                await writeFile(draft, bytes);
            }
            for (const [draft, final] of written) {
                await rename(draft, final);
            }
            return written.map(([, final]) => final);
        } catch (reason) {
            await Promise.all(written.map(([draft]) => rm(draft, { force: true })));
            throw outputError(
                `an embedding was found, but ${this.folder} cannot be written to`,
                reason,
            );
        }
    }

    /** Takes back folders that were made and stayed empty. */
    async leave(): Promise<void> {
        if (this.made === undefined) {
            return;
        }
        const top = path.resolve(this.made);
        for (let folder = path.resolve(this.folder); ; folder = path.dirname(folder)) {
            try {
                await rmdir(folder);
            } catch {
                return;
            }
            if (folder === top) {
                return;
            }
        }
    }
}

function outputError(what: string, reason: unknown): LayoutError {
    const code = (reason as { code?: string }).code ?? "unknown cause";
    return javaScriptError("outputFailed", `${what} (${code})`);
}
