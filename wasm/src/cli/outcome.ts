// Exit codes, the same for all commands.

export const exitCodes = {
    /** Done: a valid embedding was written, or `check` accepts. */
    success: 0,
    /** No embedding, or no layout, found within the limits. */
    noneFound: 1,
    /** Bad input or usage. */
    badInput: 2,
    /** Proved: there is no embedding. */
    infeasible: 3,
    /** `check` refuses. */
    refused: 4,
    /** Internal error, or out of memory. */
    internal: 5,
    /** Interrupted; the best result was written, where there was one. */
    interrupted: 130,
} as const;

/** What a command has to say, in both forms. */
export interface Outcome {
    exitCode: number;
    /** For people; may be empty. */
    text: string;
    /** For `--json`. */
    document: unknown;
}

const ourFault = new Set([
    "internal",
    "crashed",
    "memoryLimit",
    "moduleNotLoaded",
    "realisationFailed",
    "unresolvedTie",
]);

/** The exit code for an error that ended a command. */
export function exitCodeOf(errorCode: string): number {
    if (errorCode === "damagedOutput") {
        return exitCodes.refused;
    }
    if (errorCode === "templateNotReached" || errorCode === "noEmbedding") {
        return exitCodes.noneFound;
    }
    return ourFault.has(errorCode) ? exitCodes.internal : exitCodes.badInput;
}
