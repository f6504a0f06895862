import type { EmbeddingSession, EmbedResult } from "layout-embedding";
import type { Engine, Worker } from "./engine.js";

interface Open {
    readonly worker: Promise<Worker>;
    /** Of which result the session has the embedding. */
    result: EmbedResult | null;
    session: Promise<EmbeddingSession> | null;
}

/**
 * A worker apart from the engine's, for work in one long step: that can only be ended with its
 * worker, and nothing that the page shows is lost with this one.
 */
export class Workshop {
    private open: Open | null = null;

    constructor(
        private readonly engine: Engine,
        private readonly start: () => Promise<Worker>,
    ) {}

    /** A session that has the embedding of the engine's problem with the routes of `result`. */
    embedded(result: EmbedResult): Promise<EmbeddingSession> {
        const open = (this.open ??= { worker: this.start(), result: null, session: null });
        if (open.result === result && open.session) return open.session;
        const before = open.session;
        open.result = result;
        open.session = open.worker.then(async (worker) => {
            await before?.then((session) => session.dispose()).catch(() => undefined);
            const session = await worker.createSession();
            await this.engine.loadInto(session);
            await session.setLandmarks(result.landmarks, { numbering: "loaded" });
            await session.solve({
                // All embeddings with these routes cost the same: the first one does.
                gap: 1,
                constraints: result.edges.map(({ id, weakPath }) => ({
                    rule: "keep",
                    edge: id,
                    path: weakPath,
                })),
            });
            return session;
        });
        // Whoever failed does not stand in the way of the next attempt.
        open.session.catch(() => {
            if (this.open === open) this.stop();
        });
        return open.session;
    }

    /** Ends what is going on: its promise is rejected with workerTerminated. */
    stop(): void {
        const { open } = this;
        this.open = null;
        open?.worker.then((worker) => worker.terminate()).catch(() => undefined);
    }
}

/** Whether something ended because its worker was ended on purpose. */
export const isStopped = (error: unknown): boolean =>
    error instanceof Error && "code" in error && error.code === "workerTerminated";
