// One line on the terminal that follows the work; nothing where stderr goes elsewhere.
import type { EmbedProgress } from "../types.js";

const names = {
    prepare: "preparing",
    search: "searching",
    realise: "cutting the mesh",
    check: "checking",
    done: "done",
} as const satisfies Record<EmbedProgress["phase"], string>;

export class ProgressLine {
    private shown = 0;

    constructor(private readonly enabled: boolean) {}

    show(progress: EmbedProgress): void {
        const now = performance.now();
        if (!this.enabled || now - this.shown < 50) {
            return;
        }
        this.shown = now;
        const { phase, cost, lowerBound, seconds } = progress;
        const found = Number.isFinite(cost);
        // Once there is an embedding, nobody knows how long it takes to find a better one.
        const share =
            phase === "search" && found ? "" : ` ${String(Math.round(100 * progress.progress))} %`;
        const quality = found
            ? `, cost ${cost.toPrecision(6)}, gap ${(100 * (1 - lowerBound / cost)).toFixed(2)} %`
            : "";
        process.stderr.write(`\r\x1b[K${names[phase]}${share}${quality}, ${seconds.toFixed(1)} s`);
    }

    clear(): void {
        if (this.enabled) {
            process.stderr.write("\r\x1b[K");
        }
    }
}
