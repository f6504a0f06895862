import type { EmbedResult, QuadMesh, QuadOptions } from "layout-embedding";
import { causeAndAdvice } from "./describe.js";
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
    /** Counts the changes; what is made for an older one is not wanted any more. */
    private wish = 0;
    private waiting = false;
    private running = false;
    private relaxing = false;

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
                if (shown && quadMesh.of !== result) this.refresh();
                else if (!result) this.stop();
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
        ++this.wish;
        this.waiting = false;
        if (this.relaxing) this.workshop.stop();
        this.update({ phase: null });
    }

    private refresh(): void {
        ++this.wish;
        this.waiting = true;
        if (this.relaxing) this.workshop.stop();
        if (!this.running) void this.run();
    }

    private async run(): Promise<void> {
        this.running = true;
        while (this.waiting) {
            this.waiting = false;
            const made = this.wish;
            const { result, quadMesh, tab } = this.store.get();
            if (!result?.refined || tab !== "quads") break;
            try {
                await this.make(result, quadMesh, made);
            } catch (error) {
                if (made === this.wish) this.fail(error);
            }
        }
        this.running = false;
    }

    private async make(result: EmbedResult, settings: QuadState, made: number): Promise<void> {
        const { edgeLength, segments } = settings;
        const options: QuadOptions = { segments, ...(edgeLength !== null && { edgeLength }) };
        this.update({ phase: "Making quads", error: null });
        const session = await this.workshop.embedded(result);
        const rough = await session.quads({ ...options, relaxation: 0 });
        if (this.store.get().result !== result) return;
        this.show(rough, result, false);
        await new Promise((resolve) => setTimeout(resolve, calm));
        if (made !== this.wish) return;
        this.update({ phase: "Evening the quads out" });
        this.relaxing = true;
        try {
            const relaxed = await session.quads(options);
            if (made === this.wish) this.show(relaxed, result, true);
        } finally {
            this.relaxing = false;
        }
        if (made === this.wish) this.update({ phase: null });
    }

    private show(mesh: QuadMesh, of: EmbedResult, isRelaxed: boolean): void {
        this.update({ mesh, of, isRelaxed });
    }

    private fail(error: unknown): void {
        if (isStopped(error)) return this.update({ phase: null });
        const { cause, advice } = causeAndAdvice(
            error instanceof Error ? error.message : String(error),
        );
        this.update({ phase: null, error: `${cause} ${advice}`.trim() });
    }

    private update(change: Partial<QuadState>): void {
        this.store.update({ quadMesh: { ...this.store.get().quadMesh, ...change } });
    }
}
