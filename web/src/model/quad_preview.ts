import type { EmbeddingSession, EmbedResult, QuadMesh, QuadOptions } from "layout-embedding";
import { sentencesOf } from "./describe.js";
import { Latest } from "./latest.js";
import type { QuadState } from "./quads.js";
import type { AppState } from "./state.js";
import type { Store } from "./store.js";
import { isStopped, type Workshop } from "./workshop.js";

/** Milliseconds for which settings have to stay as they are before the mesh is relaxed. */
const calm = 350;

/**
 * The quad mesh of the result while its settings change: at once as it comes from the patches, and
 * relaxed when the settings rest. Newer settings take the place of older ones; a relaxation under
 * way is ended for them.
 */
export class QuadPreview {
    private readonly latest = new Latest();
    private relaxing = false;
    /** Until the settings have rested. */
    private timer: ReturnType<typeof setTimeout> | undefined;

    constructor(
        private readonly store: Store<AppState>,
        private readonly workshop: Workshop,
    ) {
        // Settings belong to a layout and a target.
        store.watch(
            (state) => [state.layout, state.target],
            () => this.update({ edgeLength: null, segments: [], error: null }),
        );
        store.watch(
            (state) => [state.tab === "quads", state.result],
            (shown, result) => {
                const { quadMesh } = store.get();
                if (quadMesh.of !== result && quadMesh.mesh)
                    this.update({ mesh: null, of: null, isRelaxed: false });
                if (shown && (quadMesh.of !== result || !quadMesh.isRelaxed)) this.refresh();
                else if (!result) this.stop();
                // Nobody waits for it: its memory goes back.
                if (!shown && !result) this.workshop.stop();
            },
        );
    }

    /** How long edges shall be; null for the usual length. */
    setEdgeLength(edgeLength: number | null): void {
        this.update({ edgeLength });
        this.refresh();
    }

    /** The number of segments of a layout edge, and with it of its whole loops; null: by length. */
    setSegments(edge: number, segments: number | null): void {
        const others = this.store.get().quadMesh.segments.filter(([other]) => other !== edge);
        this.update({ segments: segments === null ? others : [...others, [edge, segments]] });
        this.refresh();
    }

    /** Ends a relaxation; the mesh stays as it is. */
    stop(): void {
        this.interrupt();
        this.latest.drop();
        this.update({ phase: null });
    }

    private refresh(): void {
        this.interrupt();
        this.latest.do((isWanted) =>
            this.attempt(isWanted, "Making quads", async (result, session, options) => {
                const rough = await session.quads({ ...options, relaxation: 0 });
                // Shown also where a newer one is wanted: the slider is still moving.
                if (this.store.get().result !== result) return;
                this.show(rough, result, false);
                if (isWanted()) this.timer = setTimeout(() => this.relax(), calm);
            }),
        );
    }

    private relax(): void {
        this.latest.do((isWanted) =>
            this.attempt(isWanted, "Evening the quads out", async (result, session, options) => {
                this.relaxing = true;
                const relaxed = await session.quads(options);
                if (isWanted()) this.show(relaxed, result, true);
            }),
        );
    }

    private interrupt(): void {
        clearTimeout(this.timer);
        if (this.relaxing) this.workshop.stop();
    }

    private async attempt(
        isWanted: () => boolean,
        phase: string,
        make: (
            result: EmbedResult,
            session: EmbeddingSession,
            options: QuadOptions,
        ) => Promise<void>,
    ): Promise<void> {
        const { result, quadMesh, tab } = this.store.get();
        if (!result?.refined || tab !== "quads") return;
        const { edgeLength, segments } = quadMesh;
        this.update({ phase, error: null });
        try {
            await make(result, await this.workshop.embedded(result), {
                segments,
                ...(edgeLength !== null && { edgeLength }),
            });
        } catch (error) {
            if (isWanted()) this.fail(error);
        } finally {
            this.relaxing = false;
            if (isWanted()) this.update({ phase: null });
        }
    }

    private show(mesh: QuadMesh, of: EmbedResult, isRelaxed: boolean): void {
        this.update({ mesh, of, isRelaxed });
    }

    private fail(error: unknown): void {
        if (!isStopped(error)) this.update({ error: sentencesOf(error) });
    }

    private update(change: Partial<QuadState>): void {
        this.store.update({ quadMesh: { ...this.store.get().quadMesh, ...change } });
    }
}
