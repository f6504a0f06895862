// layout-embedding check: reads back what embed wrote and sends it through the core's checker,
// which shares no code with the search. Anything that does not fit is a reason to refuse.
import { stat } from "node:fs/promises";
import { javaScriptError, LayoutError } from "../errors.js";
import { Session } from "../session.js";
import type { LayoutInfo, TargetInfo, Violation } from "../types.js";
import type { CheckCommand } from "./arguments.js";
import { checkNumbers } from "./check_numbers.js";
import { fileError, readInput } from "./input_files.js";
import { exitCodes, type Outcome } from "./outcome.js";
import { readEmbedding, type WrittenEmbedding } from "./read_embedding.js";

export async function runCheck(command: CheckCommand): Promise<Outcome> {
    await confirmFolder(command.folder);
    const session = await Session.create();
    try {
        const options = { repair: command.repair };
        const layout = await session.loadLayout(
            await readInput("the layout", command.layout),
            options,
        );
        const target = await session.loadTarget(
            await readInput("the target", command.target),
            options,
        );
        const given =
            command.landmarks === null
                ? null
                : (
                      await session.setLandmarks(
                          await readInput("the landmark file", command.landmarks),
                      )
                  ).landmarks;
        const written = await readEmbedding(command.folder);
        return verdict(command, written, [
            ...checkLandmarks(written, given),
            ...(await checkEmbedding(session, layout, target, written)),
        ]);
    } finally {
        await session.dispose();
    }
}

async function confirmFolder(folder: string): Promise<void> {
    try {
        if ((await stat(folder)).isDirectory()) {
            return;
        }
    } catch (reason) {
        throw fileError("the folder", folder, reason);
    }
    throw javaScriptError("usage", `${folder} is a file, not the folder that embed wrote to`);
}

function checkLandmarks(written: WrittenEmbedding, given: Uint32Array | null): Violation[] {
    const landmarks = written.document.landmarks;
    const same =
        given === null ||
        (given.length === landmarks.length && given.every((id, place) => id === landmarks[place]));
    return same
        ? []
        : [{ code: "landmarksDiffer", message: "the landmarks are not those of the given file." }];
}

async function checkEmbedding(
    session: Session,
    layout: LayoutInfo,
    target: TargetInfo,
    written: WrittenEmbedding,
): Promise<Violation[]> {
    const { document, refined } = written;
    try {
        await session.setLandmarks(document.landmarks, { numbering: "loaded" });
        const violations = await session.check({ refined, edges: document.edges });
        return [...violations, ...checkNumbers(written, layout, target)];
    } catch (reason) {
        // The inputs are sound, so whatever does not fit them is the embedding's fault.
        if (reason instanceof LayoutError) {
            return [{ code: reason.code, message: reason.message }];
        }
        throw reason;
    }
}

function verdict(
    command: CheckCommand,
    written: WrittenEmbedding,
    violations: Violation[],
): Outcome {
    const { edges, cost } = written.document;
    const valid = violations.length === 0;
    const summary = valid
        ? `${command.folder} holds a valid embedding of ${String(edges.length)} edges`
        : `${command.folder} holds no valid embedding: ${String(violations.length)} violations`;
    return {
        exitCode: valid ? exitCodes.success : exitCodes.refused,
        text: [summary, ...violations.map(({ code, message }) => `${code}: ${message}`)].join("\n"),
        document: { valid, violations, edges: edges.length, cost },
    };
}
