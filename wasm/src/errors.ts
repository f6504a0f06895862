// Errors as users see them. The codes of the core stand in core/base/error.cc and are read from the
// WebAssembly module; only what can go wrong outside of it is listed here.

/** What a user can read about an error code. */
export interface ErrorInfo {
    /** Stable, camelCase. */
    code: string;
    /** What it means, one clause. */
    meaning: string;
    /** What to do about it, one clause. */
    advice: string;
}

/** Codes that arise in JavaScript, beside those of the core. */
export const javaScriptErrors = [
    {
        code: "invalidInput",
        meaning: "an argument has the wrong shape",
        advice: "correct the call",
    },
    {
        code: "missingInput",
        meaning: "a layout or a target has not been loaded yet",
        advice: "load both first",
    },
    {
        code: "nothingToExport",
        meaning: "there is no embedding to export",
        advice: "solve first",
    },
    {
        code: "nothingToReshape",
        meaning: "there is no embedding whose paths could get another shape",
        advice: "solve first",
    },
    {
        code: "noEmbedding",
        meaning: "the layout was not embedded in a target",
        advice: "check its landmarks or raise the limits",
    },
    {
        code: "noReference",
        meaning: "there is no reference to map from, or no map yet",
        advice: "solve, call setReference(), solve with another target, then map",
    },
    {
        code: "cancelled",
        meaning: "a call was aborted by its signal",
        advice: "call again, or wait for the best result so far (CancelledError.late)",
    },
    {
        code: "disposed",
        meaning: "the session was disposed of",
        advice: "create another session",
    },
    {
        code: "moduleNotLoaded",
        meaning: "the WebAssembly module could not be loaded",
        advice: "check its address, or hand its bytes to init()",
    },
    {
        code: "crashed",
        meaning: "the solver ran into a trap and its state is lost",
        advice: "create another session and report this input as a bug",
    },
    {
        code: "workerFailed",
        meaning: "the worker could not be started or stopped by itself",
        advice: "check the browser's console, then create another worker",
    },
    {
        code: "workerTerminated",
        meaning: "the worker was terminated while work was pending",
        advice: "create another worker",
    },
    {
        code: "fileNotFound",
        meaning: "a file does not exist",
        advice: "check the path",
    },
    {
        code: "fileUnreadable",
        meaning: "a file cannot be read",
        advice: "give a regular file that you may read",
    },
    {
        code: "outputFailed",
        meaning: "a result cannot be written",
        advice: "choose a folder that you may write to",
    },
    {
        code: "damagedOutput",
        meaning: "a written embedding is incomplete or was changed",
        advice: "embed again",
    },
    {
        code: "usage",
        meaning: "the command line cannot be understood",
        advice: "see layout-embedding --help",
    },
] as const satisfies readonly ErrorInfo[];

export type JavaScriptErrorCode = (typeof javaScriptErrors)[number]["code"];

/** The one kind of error this package throws or rejects with. */
export class LayoutError extends Error {
    /** Always the same; messages between threads lose the class. */
    override readonly name = "LayoutError";

    /**
     * @param code stable, camelCase: a code of the core or one of `javaScriptErrors`
     * @param message one sentence that says what, where and what to do
     * @param details the places as numbers, for example { face: 12 }; ids 0-based, lines 1-based
     */
    constructor(
        readonly code: string,
        message: string,
        readonly details: Readonly<Record<string, number>> = {},
    ) {
        super(message);
    }
}

/** An error whose message reads "<whatAndWhere>; <advice of the code>.". */
export function javaScriptError(
    code: JavaScriptErrorCode,
    whatAndWhere: string,
    details: Record<string, number> = {},
): LayoutError {
    const advice = javaScriptErrors.find((info) => info.code === code)?.advice ?? "";
    return new LayoutError(code, `${whatAndWhere}; ${advice}.`, details);
}

/** Anything thrown, as a LayoutError. */
export function asLayoutError(thrown: unknown): LayoutError {
    if (thrown instanceof LayoutError) {
        return thrown;
    }
    const message = thrown instanceof Error ? thrown.message : String(thrown);
    return new LayoutError("internal", `unexpected error: ${message}; report this input as a bug.`);
}

/** What an aborted call rejects with that has no result to give at once. */
export class CancelledError extends LayoutError {
    /**
     * What the call comes to: of solve(), reshape(), quads() and mapFromReference() the best result so
     * far, once it is finished. Calls of the same session wait for it. Rejects with `cancelled` where
     * nothing is left to be finished; never reported as unhandled.
     */
    readonly late: Promise<unknown>;

    constructor(late?: Promise<unknown>) {
        const { code, message } = javaScriptError("cancelled", "the call was aborted");
        super(code, message);
        this.late = late ?? Promise.reject(this);
        this.late.catch(() => undefined);
    }
}
