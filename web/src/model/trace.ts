import type { EmbedProgress, EmbedResult, Polylines } from "layout-embedding";

/** The state of a search at one time. */
export interface TracePoint {
    readonly seconds: number;
    /** Infinity while there is no embedding. */
    readonly cost: number;
    readonly lowerBound: number;
}

/** An embedding that was the best when it was found. */
export interface Incumbent extends TracePoint {
    readonly paths: Polylines;
}

/** How a solve went: both bounds over time, and every improvement. */
export interface Trace {
    readonly points: readonly TracePoint[];
    readonly incumbents: readonly Incumbent[];
}

export const emptyTrace: Trace = { points: [], incumbents: [] };

/** Improvements kept with their paths; more would fill the memory on large targets. */
const maximumIncumbents = 200;

/** Collects a trace from the progress of a running solve. */
export class TraceRecorder {
    private readonly points: TracePoint[] = [];
    private incumbents: Incumbent[] = [];

    add({ seconds, cost, lowerBound, paths }: EmbedProgress): void {
        const point = { seconds, cost, lowerBound };
        const last = this.points.at(-1);
        if (last?.cost !== cost || last.lowerBound !== lowerBound) this.points.push(point);
        const best = this.incumbents.at(-1)?.cost ?? Infinity;
        if (paths && cost < best) {
            this.incumbents.push({ ...point, paths });
            if (this.incumbents.length > maximumIncumbents)
                this.incumbents = this.incumbents.filter((_, i) => i % 2 === 1);
        }
    }

    /** The trace so far, as it was at `seconds`. */
    snapshot(seconds: number): Trace {
        const last = this.points.at(-1);
        const points = last ? [...this.points, { ...last, seconds }] : [];
        return { points, incumbents: [...this.incumbents] };
    }

    /** The trace of a finished solve, with every event of it. */
    finished(result: EmbedResult): Trace {
        const points = result.events
            .filter(({ kind }) => kind === "incumbent" || kind === "bound")
            .map(({ seconds, cost, lowerBound }) => ({ seconds, cost, lowerBound }));
        const { seconds, cost, lowerBound } = result;
        return { points: [...points, { seconds, cost, lowerBound }], incumbents: this.incumbents };
    }
}
