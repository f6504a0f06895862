// layout-embedding convert: what embed wrote, or a mesh, in another format.
import { rename, rm, stat, writeFile } from "node:fs/promises";
import { Core } from "../core.js";
import { javaScriptError } from "../errors.js";
import { convertMesh, exportClaim, exportFormats } from "../formats.js";
import type { ExportFormat } from "../types.js";
import type { ConvertCommand } from "./arguments.js";
import { readInput } from "./input_files.js";
import { exitCodes, type Outcome } from "./outcome.js";
import { readEmbedding } from "./read_embedding.js";

export async function runConvert(command: ConvertCommand): Promise<Outcome> {
    const { input, output } = command;
    const isFolder = await stat(input).then(
        (there) => there.isDirectory(),
        () => false,
    );
    const bytes = isFolder
        ? await convertEmbedding(command)
        : await convertMesh(await readInput("the mesh", input), output);
    const draft = `${output}.part`;
    try {
        await writeFile(draft, bytes);
        await rename(draft, output);
    } catch (reason) {
        await rm(draft, { force: true });
        const code = (reason as { code?: string }).code ?? "unknown cause";
        throw javaScriptError("outputFailed", `${output} cannot be written (${code})`);
    }
    return {
        exitCode: exitCodes.success,
        text: `written: ${output}`,
        document: { file: output, bytes: bytes.length },
    };
}

async function convertEmbedding({ input, output, view }: ConvertCommand): Promise<Uint8Array> {
    const format = exportFormats.find(
        (name): name is Exclude<ExportFormat, "lem"> =>
            name !== "lem" && output.toLowerCase().endsWith(`.${name}`),
    );
    if (format === undefined) {
        throw javaScriptError(
            "usage",
            `an embedding can be written as .obj, .ply, .vtp, .glb or .svg, not as ${output}`,
        );
    }
    const { document, refined } = await readEmbedding(input);
    return exportClaim(await Core.create(), { refined, edges: document.edges }, format, view);
}
