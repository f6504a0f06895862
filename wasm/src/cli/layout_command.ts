// layout-embedding layout: a template layout from a landmarked target.
import { access, constants, rename, rm, stat, writeFile } from "node:fs/promises";
import path from "node:path";
import { javaScriptError, type LayoutError } from "../errors.js";
import { templateLayout } from "../index.js";
import type { TemplateLayout } from "../types.js";
import type { LayoutCommand } from "./arguments.js";
import { readInput } from "./input_files.js";
import { exitCodes, type Outcome } from "./outcome.js";

export async function runLayout(command: LayoutCommand): Promise<Outcome> {
    await confirmWritable(command.output);
    const layout = await templateLayout(
        {
            target: await readInput("the target", command.target),
            landmarks: await readInput("the landmark file", command.landmarks),
        },
        { quads: command.quads, repair: command.repair },
    );
    await write(command.output, layout.obj);
    if (!command.quiet && !command.json) {
        for (const note of layout.notes) {
            process.stderr.write(`note: ${note}\n`);
        }
    }
    const faces = faceCounts(layout);
    return {
        exitCode: exitCodes.success,
        text: command.quiet ? "" : summaryText(command, layout, faces),
        document: {
            file: command.output,
            vertices: layout.positions.length / 3,
            ...faces,
            landmarks: Array.from(layout.landmarks),
            removed: layout.removed,
            flips: layout.flips,
            notes: layout.notes,
        },
    };
}

function faceCounts({ offsets }: TemplateLayout): { triangles: number; quads: number } {
    let triangles = 0;
    for (let face = 0; face + 1 < offsets.length; ++face) {
        triangles += (offsets[face + 1] ?? 0) - (offsets[face] ?? 0) === 3 ? 1 : 0;
    }
    return { triangles, quads: offsets.length - 1 - triangles };
}

function summaryText(
    command: LayoutCommand,
    layout: TemplateLayout,
    { triangles, quads }: { triangles: number; quads: number },
): string {
    const { collapses, afterFlips, inAnyShape } = layout.removed;
    const faces = [
        ...(quads > 0 ? [`${String(quads)} quads`] : []),
        ...(triangles > 0 ? [`${String(triangles)} triangles`] : []),
    ];
    return [
        `layout of ${String(layout.positions.length / 3)} vertices, ${faces.join(" and ")}`,
        `removed: ${String(collapses)} vertices by collapses, ${String(afterFlips)} after edge ` +
            `flips, ${String(inAnyShape)} without regard to shapes`,
        `flipped: ${String(layout.flips)} edges whose other diagonal is shorter`,
        `written: ${command.output}`,
    ].join("\n");
}

/** Throws outputFailed, before any work, where the file cannot be written. */
async function confirmWritable(file: string): Promise<void> {
    const isFolder = await stat(file).then(
        (there) => there.isDirectory(),
        () => false,
    );
    if (isFolder) {
        throw javaScriptError("outputFailed", `the output file ${file} is a folder`);
    }
    try {
        await access(path.dirname(file), constants.W_OK | constants.X_OK);
    } catch (reason) {
        throw outputError(file, reason);
    }
}

/** Writes the whole file or nothing. */
async function write(file: string, bytes: Uint8Array): Promise<void> {
    const draft = `${file}.part`;
    try {
        await writeFile(draft, bytes);
        await rename(draft, file);
    } catch (reason) {
        await rm(draft, { force: true });
        throw outputError(file, reason);
    }
}

function outputError(file: string, reason: unknown): LayoutError {
    const code = (reason as { code?: string }).code ?? "unknown cause";
    return javaScriptError("outputFailed", `the layout ${file} cannot be written (${code})`);
}
