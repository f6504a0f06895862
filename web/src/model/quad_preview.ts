import type {
    EmbeddingSession,
    EmbedResult,
    LayoutInfo,
    QuadMesh,
    QuadOptions,
} from "layout-embedding";
import { sentencesOf } from "./describe.js";
import { isStopped } from "./engine.js";
import { Latest } from "./latest.js";
import type { QuadState } from "./quads.js";
import type { SavedRest } from "./saved_work.js";
import { pathOptions } from "./solve_options.js";
import type { AppState } from "./state.js";
import type { Store } from "./store.js";
import type { Workshop } from "./workshop.js";

/** Milliseconds after which newer settings do not wait for a mesh that is being made. */
const patience = 1000;
/** Milliseconds for which settings have to stay as they are before the mesh is relaxed. */
const calm = 350;

/**
 * The quad mesh of the result while its settings change: at once as it comes from the patches, and
 * relaxed when the settings rest. Newer settings take the place of older ones; a relaxation under
 * way is ended for them.
 */
export class QuadPreview {
    private readonly latest = new Latest();
    /** Ends what is being made; a relaxation is ended for newer settings, too. */
    private making = new AbortController();
    private relaxing = new AbortController();
    /** performance.now() when the mesh that is being made was begun; null while none is. */
    private makingSince: number | null = null;
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
                if (!shown && !result) this.workshop.close();
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

    /** Settings that were put away; edges that the layout has not are left out. */
    restore({ edgeLength, segments }: SavedRest["quadMesh"], { edgeCount }: LayoutInfo): void {
        this.update({ edgeLength, segments: segments.filter(([edge]) => edge < edgeCount) });
    }

    /** Ends what is going on; the mesh stays as it is. */
    stop(): void {
        this.interrupt();
        this.latest.drop();
        this.abortMaking();
        this.workshop.interrupt();
        this.update({ phase: null });
    }

    private refresh(): void {
        this.interrupt();
        if (this.makingSince !== null && performance.now() - this.makingSince > patience)
            this.abortMaking();
        this.latest.do((isWanted) =>
            this.attempt(isWanted, "Making quads", async (result, session, options) => {
                const { signal } = this.making;
                this.makingSince = performance.now();
                const rough = await session
                    .quads({ ...options, relaxation: 0, signal })
                    .finally(() => (this.makingSince = null));
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
                this.relaxing = new AbortController();
                const { signal } = this.relaxing;
                const onProgress = (progress: number) => this.update({ progress });
                const relaxed = await session.quads({ ...options, signal, onProgress });
                if (isWanted()) this.show(relaxed, result, true);
            }),
        );
    }

    private abortMaking(): void {
        this.making.abort();
        this.making = new AbortController();
    }

    private interrupt(): void {
        clearTimeout(this.timer);
        this.relaxing.abort();
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
        const { result, quadMesh, tab, options } = this.store.get();
        if (!result?.refined || tab !== "quads") return;
        const { edgeLength, segments } = quadMesh;
        this.update({ phase, progress: null, error: null });
        try {
            // The patches as they are shown.
            const wanted = { ...pathOptions(options), shape: options.shape };
            await this.workshop.with(result, wanted, ({ session }) =>
                make(result, session, { segments, ...(edgeLength !== null && { edgeLength }) }),
            );
        } catch (error) {
            if (isWanted()) this.fail(error);
        } finally {
            if (isWanted()) this.update({ phase: null, progress: null });
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
