import type { LandmarkEditor } from "./landmark_editor.js";
import { formatChange, formatLength } from "./describe.js";
import { keptRule, ruleFor, type RouteRule } from "./routes.js";
import type { AppState } from "./state.js";
import type { Store } from "./store.js";

/** What a person asks of single paths; each wish is an edit that can be taken back. */
export class RouteEditor {
    constructor(
        private readonly store: Store<AppState>,
        private readonly editor: LandmarkEditor,
        /** Resolves when what was changed has been solved. */
        private readonly solved: () => Promise<void>,
    ) {}

    /** Asks for the best embedding in which a layout edge takes another route. */
    async another(edge: number): Promise<void> {
        const { result, routes, activity } = this.store.get();
        const embedded = result?.edges[edge];
        if (!result || !embedded || activity) return;
        const before = result.cost;
        const changed = [
            ...routes.filter((one) => one !== keptRule(routes, edge)),
            ruleFor("avoid", embedded, before),
        ];
        this.editor.setRoutes(changed, `Another route is looked for, for edge ${edge}.`);
        await this.solved();
        const now = this.store.get();
        if (now.routes !== changed || !now.result?.refined) return;
        this.store.update({
            announcement:
                `Edge ${edge} takes another route. All edges cost ${formatLength(now.result.cost)}, ` +
                `${formatChange(before, now.result.cost)}.`,
        });
    }

    /** Whatever else changes, a layout edge keeps its route; or it need not any more. */
    toggleKept(edge: number): void {
        const { result, routes, activity } = this.store.get();
        const kept = keptRule(routes, edge);
        const embedded = result?.edges[edge];
        if (kept) return void this.remove(kept);
        if (!embedded || activity) return;
        this.editor.keepRoutes(
            [...routes, ruleFor("keep", embedded, null)],
            `Edge ${edge} keeps its route.`,
        );
    }

    async remove(rule: RouteRule): Promise<void> {
        const { routes, activity } = this.store.get();
        if (activity?.kind === "loading") return;
        this.editor.setRoutes(
            routes.filter((one) => one !== rule),
            `The rule for edge ${rule.edge} was removed.`,
        );
        await this.solved();
    }
}
