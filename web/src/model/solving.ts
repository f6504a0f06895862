import type { EmbedProgress } from "layout-embedding";
import { improvingWords, phaseWords } from "./describe.js";
import type { Engine } from "./engine.js";
import { unsolved } from "./landmark_editor.js";
import { completeIds } from "./landmarks.js";
import { heuristicOptions, solveOptions } from "./solve_options.js";
import { startedActivity, type AppState } from "./state.js";
import type { Store } from "./store.js";
import { TraceRecorder } from "./trace.js";

/** A preview's search ends here, so that it keeps up with the hand. */
const previewSeconds = 0.4;

/** Searches for embeddings of what is open, and what is shown of them while they run. */
export class Solving {
    private abort: AbortController | null = null;
    private previewing = false;

    constructor(
        private readonly store: Store<AppState>,
        private readonly engine: Engine,
        private readonly report: (error: unknown) => void,
    ) {}

    /** Ends a running solve; what it has found stays. */
    cancel(): void {
        const { activity } = this.store.get();
        if (!this.abort || activity?.kind !== "solving") return;
        this.abort.abort();
        this.store.update({ activity: { ...activity, cancelling: true } });
    }

    /**
     * A quick embedding for a landmark that moves; skipped while one is being made. What the engine
     * has solved follows where it can; otherwise a heuristic makes one anew.
     */
    async preview(id: number): Promise<void> {
        if (this.previewing || !this.store.get().live || this.store.get().making) return;
        this.cancel();
        this.previewing = true;
        try {
            for (;;) {
                const { landmarks } = this.store.get();
                const ids = landmarks && completeIds(landmarks);
                if (!ids) return;
                const follow = await this.engine.follow(id, ids);
                const quick = follow ? { follow } : await this.greedyBeside(ids);
                const now = this.store.get();
                // The hand may have gone on, or come to rest and been overtaken by the full solve.
                if (now.result || now.activity) return;
                this.store.update(quick);
                if (now.landmarks === landmarks) return;
            }
        } catch {
            // Two landmarks in one place and the like: the full solve says what is wrong.
        } finally {
            this.previewing = false;
        }
    }

    private async greedyBeside(ids: Uint32Array): Promise<Pick<AppState, "preview" | "follow">> {
        const preview = await this.engine.solveBeside(ids, {
            ...heuristicOptions(this.store.get().options),
            algorithm: "greedy",
            timeLimit: previewSeconds,
        });
        return { preview, follow: null };
    }

    /** Solves what is open; shows how that goes, and what comes of it. */
    async run(): Promise<void> {
        const { layout, target, landmarks, options, routes } = this.store.get();
        const ids = landmarks && completeIds(landmarks);
        if (!layout || !target || !ids) return;
        const abort = new AbortController();
        this.abort = abort;
        this.store.update({
            ...unsolved,
            activity: startedActivity("solving", phaseWords.prepare),
            preview: this.store.get().preview,
            follow: this.store.get().follow,
            problems: [],
            shownPlace: null,
        });
        const recorder = new TraceRecorder();
        // The views are brought up to date once per frame, however often the worker reports.
        let latest: EmbedProgress | null = null;
        let paths: EmbedProgress["paths"] = null;
        let frame = 0;
        const showLatest = () => {
            frame = 0;
            if (latest) this.showProgress(latest, paths, recorder);
            paths = null;
        };
        try {
            await this.engine.useLandmarks(ids);
            const result = await this.engine.solve({
                ...solveOptions(options, routes),
                signal: abort.signal,
                onProgress: (progress) => {
                    recorder.add(progress);
                    latest = progress;
                    paths = progress.paths ?? paths;
                    frame ||= requestAnimationFrame(showLatest);
                },
            });
            cancelAnimationFrame(frame);
            showLatest();
            // Landmarks that were edited meanwhile belong to another problem.
            const now = this.store.get().landmarks;
            if (now && sameIds(completeIds(now), ids))
                this.store.update({
                    result,
                    trace: recorder.finished(result),
                    preview: null,
                    follow: null,
                });
        } catch (error) {
            this.report(error);
        } finally {
            cancelAnimationFrame(frame);
            this.abort = null;
            this.store.update({ activity: null });
        }
    }

    private showProgress(
        { phase, progress, cost, lowerBound, seconds }: EmbedProgress,
        paths: EmbedProgress["paths"],
        recorder: TraceRecorder,
    ): void {
        const { activity: current } = this.store.get();
        if (!current) return;
        // Once there is an embedding, nobody knows how long it takes to find a better one.
        const improving = phase === "search" && Number.isFinite(cost);
        this.store.update({
            activity: {
                ...current,
                phase:
                    phase === "done"
                        ? current.phase
                        : improving
                          ? improvingWords
                          : phaseWords[phase],
                progress: improving ? null : progress,
                cost,
                lowerBound,
            },
            trace: recorder.snapshot(seconds),
            ...(paths ? { livePaths: paths, preview: null, follow: null } : {}),
        });
    }
}

function sameIds(a: Uint32Array | null, b: Uint32Array): boolean {
    return a?.length === b.length && a.every((vertex, i) => vertex === b[i]);
}
