// One layout, many targets: each is embedded into with the landmarks of the file beside it.
import type { EmbedResult, ExportedFiles } from "layout-embedding";
import { strToU8 } from "fflate";
import { sentencesOf } from "./describe.js";
import type { Engine } from "./engine.js";
import { solveOptions } from "./solve_options.js";
import type { BatchEntry, BatchFigures, SolveSettings } from "./state.js";

/** A landmark file's name after that of its target: "cow.txt", "cow_landmarks.txt". */
const landmarkSuffix = /[._-]landmarks$/i;
export const isLandmarkFile = ({ name }: File) => /\.(txt|vts|pp|json)$/i.test(name);
const baseOf = ({ name }: File) => name.replace(/(\.mrk)?\.[^.]*$/i, "");

/** The targets among some files, each with the landmark file named like it, and what is left. */
export function pairFiles(files: readonly File[]): {
    entries: BatchEntry[];
    leftOver: readonly File[];
} {
    const landmarkFiles = new Map(
        files
            .filter(isLandmarkFile)
            .map((file) => [baseOf(file).replace(landmarkSuffix, "").toLowerCase(), file]),
    );
    const entries = files
        .filter((file) => !isLandmarkFile(file))
        .sort((a, b) => a.name.localeCompare(b.name, "en", { numeric: true }))
        .map((target): BatchEntry => {
            const key = baseOf(target).toLowerCase();
            const landmarks = landmarkFiles.get(key) ?? null;
            landmarkFiles.delete(key);
            return { target, landmarks, state: "waiting", figures: null, error: null };
        });
    return { entries, leftOver: [...landmarkFiles.values()] };
}

/** Solves entry after entry, and keeps the files of those that were embedded. */
export class Batch {
    private files: (ExportedFiles | null)[] = [];
    private abort: AbortController | null = null;

    constructor(
        private readonly engine: Engine,
        private readonly changed: (entries: readonly BatchEntry[], running: boolean) => void,
    ) {}

    async run(
        entries: readonly BatchEntry[],
        repair: boolean,
        settings: SolveSettings,
    ): Promise<void> {
        this.abort?.abort();
        const abort = new AbortController();
        this.abort = abort;
        const files: (ExportedFiles | null)[] = entries.map(() => null);
        this.files = files;
        const shown = [...entries];
        const tell = (place: number, change: Partial<BatchEntry>) => {
            shown[place] = { ...shown[place]!, ...change };
            // A batch that another one has taken the place of is silent.
            if (this.abort === abort) this.changed([...shown], true);
        };
        for (const [place, entry] of entries.entries()) {
            if (abort.signal.aborted) break;
            tell(place, { state: "running" });
            try {
                const solved = await this.solve(entry, repair, settings, abort.signal);
                files[place] = solved.files;
                tell(place, { state: "done", figures: figuresOf(solved.result) });
            } catch (error) {
                tell(place, { state: "failed", error: sentencesOf(error) });
            }
        }
        if (this.abort === abort) this.changed([...shown], false);
    }

    cancel(): void {
        this.abort?.abort();
    }

    /** A folder per embedded target, and a table of all. */
    packed(entries: readonly BatchEntry[]): Record<string, Uint8Array> {
        const packed: Record<string, Uint8Array> = { "summary.csv": strToU8(table(entries)) };
        entries.forEach(({ target }, place) => {
            for (const [name, bytes] of Object.entries(this.files[place] ?? {}))
                packed[`${baseOf(target)}/${name}`] = bytes as Uint8Array;
        });
        return packed;
    }

    private async solve(
        { target, landmarks }: BatchEntry,
        repair: boolean,
        settings: SolveSettings,
        signal: AbortSignal,
    ) {
        return this.engine.solveElsewhere(
            { name: target.name, bytes: await target.arrayBuffer() },
            landmarks && { name: landmarks.name, bytes: await landmarks.arrayBuffer() },
            { repair },
            { ...solveOptions(settings), signal },
        );
    }
}

function figuresOf(result: EmbedResult): BatchFigures {
    const { status, cost, lowerBound, gap, boundScope, seconds } = result;
    const length = result.refined ? result.edges.reduce((sum, edge) => sum + edge.length, 0) : null;
    return { status, cost, lowerBound, gap, boundScope, seconds, length };
}

/** As comma-separated values; what is unknown stays empty. */
function table(entries: readonly BatchEntry[]): string {
    const text = (value: string) => `"${value.replaceAll('"', '""')}"`;
    const number = (value: number | null | undefined) =>
        value === null || value === undefined || !Number.isFinite(value) ? "" : String(value);
    const lines = entries.map(({ target, landmarks, state, figures, error }) =>
        [
            text(target.name),
            text(landmarks?.name ?? ""),
            figures?.status ?? state,
            number(figures?.cost),
            number(figures?.lowerBound),
            number(figures?.length === null ? null : figures?.gap),
            figures?.boundScope ?? "",
            number(figures?.length),
            number(figures?.seconds),
            text(error ?? ""),
        ].join(","),
    );
    const head = "target,landmarks,status,cost,lowerBound,gap,boundScope,length,seconds,error";
    return `${[head, ...lines].join("\n")}\n`;
}
