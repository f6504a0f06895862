import type { EmbeddingSession, EmbedResult, SolveOptions } from "layout-embedding";
import { CancelledError } from "layout-embedding/worker";
import { isFatal, isStopped, type Engine, type Worker } from "./engine.js";

/** A session with the embedding of a result. */
export interface Embedded {
    readonly session: EmbeddingSession;
    /** As in TargetInfo. */
    readonly textureCoordinates: Float64Array | null;
}

interface Open {
    readonly result: EmbedResult;
    readonly embedded: Promise<Embedded>;
    readonly abort: AbortController;
}

/** A worker apart from the engine's: for long work beside what the page shows. */
export class Workshop {
    private worker: Promise<Worker> | null = null;
    private open: Open | null = null;

    constructor(
        private readonly engine: Engine,
        private readonly start: () => Promise<Worker>,
        /** Whether texture coordinates of the target are of use. */
        private readonly textured = false,
    ) {}

    /**
     * Has `work` done with a session that has the embedding of the engine's problem with the paths
     * of `result`, which was found with `options`.
     */
    async with<Made>(
        result: EmbedResult,
        options: SolveOptions,
        work: (embedded: Embedded) => Promise<Made>,
    ): Promise<Made> {
        if (this.open?.result !== result) {
            this.close();
            this.open = this.opened(result, options);
        }
        const { open } = this;
        let embedded: Embedded | null = null;
        try {
            embedded = await open.embedded;
            return await work(embedded);
        } catch (error) {
            // Whoever failed does not stand in the way of the next attempt.
            if (!embedded && this.open === open) this.open = null;
            if (isFatal(error) && !isStopped(error)) this.replaceWorker();
            throw error;
        }
    }

    /** Ends an embedding that is being made; the next one who needs it has it made again. */
    interrupt(): void {
        this.open?.abort.abort();
    }

    /** Gives memory back. */
    close(): void {
        const { open } = this;
        this.open = null;
        open?.abort.abort();
        open?.embedded
            .then(({ session }) => session.dispose())
            // One that failed has been disposed of.
            .catch(() => undefined);
    }

    private opened(result: EmbedResult, options: SolveOptions): Open {
        const abort = new AbortController();
        this.worker ??= this.start();
        return { result, abort, embedded: this.embed(this.worker, result, options, abort.signal) };
    }

    private async embed(
        worker: Promise<Worker>,
        result: EmbedResult,
        options: SolveOptions,
        signal: AbortSignal,
    ): Promise<Embedded> {
        const session = await (await worker).createSession();
        try {
            const target = await this.engine.loadInto(session, {
                textureCoordinates: this.textured,
                signal,
            });
            await session.setLandmarks(result.landmarks, { numbering: "loaded" });
            const { refined } = await session.solve({
                ...options,
                doubts: false,
                given: result.edges.map(({ weakPath }) => ({ weakPath })),
                signal,
            });
            // Aborted so early that there is nothing yet.
            if (!refined) throw new CancelledError();
            return { session, textureCoordinates: target?.textureCoordinates ?? null };
        } catch (error) {
            await session.dispose().catch(() => undefined);
            throw error;
        }
    }

    private replaceWorker(): void {
        this.worker?.then((worker) => worker.terminate()).catch(() => undefined);
        this.worker = this.open = null;
    }
}
