// The package's entry: `embed` for one call, `Session` for everything else. The same API in a
// worker is the subpath "layout-embedding/worker".
import { batchIn } from "./batch.js";
import { Core } from "./core.js";
import { javaScriptErrors, type ErrorInfo } from "./errors.js";
import { Session } from "./session.js";
import { embedIn, mapIn, templateIn } from "./sugar.js";
import type {
    BatchMember,
    BatchOptions,
    BatchRow,
    EmbedOptions,
    EmbedProblem,
    EmbedResult,
    LoadOptions,
    MeshInput,
    SurfaceMap,
    SurfaceMapOptions,
    SurfaceMapProblem,
    TemplateLayout,
    TemplateOptions,
    TemplateProblem,
} from "./types.js";

export { init, type InitOptions, type WasmSource } from "./loader.js";
export { Session } from "./session.js";
export { CancelledError, LayoutError, type ErrorInfo } from "./errors.js";
export { batchTable } from "./batch.js";
export { readReferenceInput } from "./formats.js";
export { mapFiles } from "./map_files.js";
export { facePatches, pathPoints } from "./unrefined.js";
export { algorithmNames, pathShapeNames } from "./names.js";
export type { EmbeddingDocument, InputRecord, RefinedMapDocument } from "./files.js";
export type * from "./types.js";

/**
 * Embeds a layout into a target, in the calling thread: in slices of 15 ms, with a turn for other
 * events in between. Rejects with a LayoutError where the input is bad.
 */
export async function embed(
    problem: EmbedProblem,
    options: EmbedOptions = {},
): Promise<EmbedResult> {
    const session = await Session.create();
    try {
        return await embedIn(session, problem, options);
    } finally {
        await session.dispose();
    }
}

/**
 * Makes a layout of a target by collapsing its edges until only the landmarks are left; layout
 * vertex i is landmark i. Rejects with a LayoutError where the input is bad or there is none.
 */
export async function templateLayout(
    problem: TemplateProblem,
    options: TemplateOptions & LoadOptions = {},
): Promise<TemplateLayout> {
    const session = await Session.create();
    try {
        return await templateIn(session, problem, options);
    } finally {
        await session.dispose();
    }
}

/**
 * Embeds a layout in two targets and maps these onto each other through the layout's faces. Rejects
 * with a LayoutError where the input is bad or one of the embeddings is not found.
 */
export async function mapSurfaces(
    problem: SurfaceMapProblem,
    options: EmbedOptions & SurfaceMapOptions = {},
): Promise<SurfaceMap> {
    const session = await Session.create();
    try {
        return await mapIn(session, problem, options);
    } finally {
        await session.dispose();
    }
}

/**
 * Embeds a layout in many targets, makes quad meshes of the same connectivity and maps from one of
 * the targets to all others. What goes wrong with a member stands in its row and does not stop the
 * rest; rejects only where the layout or the options are bad.
 */
export async function batch(
    layout: MeshInput,
    members: readonly BatchMember[],
    options: BatchOptions = {},
): Promise<BatchRow[]> {
    const session = await Session.create();
    try {
        return await batchIn(session, layout, members, options);
    } finally {
        await session.dispose();
    }
}

/** Every error code with its meaning: the core's, then those that arise in JavaScript. */
export async function errorInfos(): Promise<ErrorInfo[]> {
    return [...(await Core.create()).errorTable(), ...javaScriptErrors];
}

/** The version of the solver. */
export async function version(): Promise<string> {
    return (await Core.create()).version();
}
