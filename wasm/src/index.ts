// The package's entry: `embed` for one call, `Session` for everything else. The same API in a
// worker is the subpath "layout-embedding/worker".
import { Core } from "./core.js";
import { javaScriptErrors, type ErrorInfo } from "./errors.js";
import { Session } from "./session.js";
import { embedIn, templateIn } from "./sugar.js";
import type {
    EmbedOptions,
    EmbedProblem,
    EmbedResult,
    LoadOptions,
    TemplateLayout,
    TemplateOptions,
    TemplateProblem,
} from "./types.js";

export { init, type InitOptions, type WasmSource } from "./loader.js";
export { Session } from "./session.js";
export { LayoutError, type ErrorInfo } from "./errors.js";
export { readReferenceInput } from "./formats.js";
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

/** Every error code with its meaning: the core's, then those that arise in JavaScript. */
export async function errorInfos(): Promise<ErrorInfo[]> {
    return [...(await Core.create()).errorTable(), ...javaScriptErrors];
}

/** The version of the solver. */
export async function version(): Promise<string> {
    return (await Core.create()).version();
}
