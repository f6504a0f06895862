import type { EmbedResult, LayoutInfo, TargetInfo } from "layout-embedding";
import type { Actions } from "../model/actions.js";
import { formatLength } from "../model/describe.js";
import type { AppState, Item } from "../model/state.js";
import type { Store } from "../model/store.js";
import { onThemeChange } from "../view3d/colors.js";
import { LayoutView, TargetView } from "../view3d/views.js";
import { element, setText } from "./dom.js";

const keys = "Arrow keys turn it, plus and minus zoom.";

/** Both 3D views and the options beside them. Throws if WebGL is not available. */
export function stage(
    store: Store<AppState>,
    actions: Actions,
): { resetView: () => void; screenshot: () => Promise<Blob> } {
    const targetView = new TargetView(element("target-view", HTMLElement), `Target in 3D. ${keys}`);
    const layoutView = new LayoutView(element("layout-view", HTMLElement), `Layout in 3D. ${keys}`);
    const views = [targetView, layoutView];
    for (const view of views) {
        view.applyTheme();
        view.onHover = (item) => actions.highlight(item);
    }
    onThemeChange(() => {
        for (const view of views) view.applyTheme();
        targetView.setSurface(...surfaceOf(store.get()));
    });

    targetView.viewer.onPoseChange = () => {
        if (store.get().camerasLinked) layoutView.viewer.setPose(targetView.viewer.pose());
    };
    layoutView.viewer.onPoseChange = () => {
        if (store.get().camerasLinked) targetView.viewer.setPose(layoutView.viewer.pose());
    };

    store.watch(
        (state) => [state.target],
        (target) => targetView.setTarget(target),
    );
    store.watch(
        (state) => [state.layout],
        (layout) => layoutView.setLayout(layout),
    );
    store.watch(surfaceOf, (target, result, layout) => {
        targetView.setSurface(target, result, layout);
    });
    // After the surface: the dots take their normals from it.
    store.watch(
        (state) => [state.target, state.landmarks],
        (target, landmarks) => targetView.setLandmarks(target, landmarks?.ids ?? null),
    );
    store.watch(
        (state) => [state.result, state.livePaths],
        (result, livePaths) => targetView.setPaths(result, livePaths),
    );
    store.watch(
        (state) => [state.wireframe],
        (wireframe) => targetView.setWireframe(wireframe),
    );
    store.watch(
        (state) => [state.highlight, state.result, state.livePaths, state.layout],
        () => {
            const { highlight } = store.get();
            for (const view of views) view.highlight(highlight);
            setText("target-hover", highlight ? describe(highlight, store.get()) : "");
        },
    );
    store.watch(
        (state) => [state.layoutShown],
        (shown) => {
            element("layout-view", HTMLElement).hidden = !shown;
            element("stage", HTMLElement).classList.toggle("alone", !shown);
        },
    );

    const resetView = () => {
        for (const view of views) view.viewer.resetView();
    };
    element("reset-view", HTMLButtonElement).addEventListener("click", resetView);
    checkbox("show-patches", "patchesShown");
    checkbox("show-wireframe", "wireframe");
    checkbox("show-layout", "layoutShown");
    checkbox("link-cameras", "camerasLinked");
    return { resetView, screenshot: () => targetView.viewer.screenshot() };

    function checkbox(
        id: string,
        field: "layoutShown" | "patchesShown" | "wireframe" | "camerasLinked",
    ): void {
        const box = element(id, HTMLInputElement);
        box.addEventListener("change", () => actions.show({ [field]: box.checked }));
        store.watch(
            (state) => [state[field]],
            (on) => {
                box.checked = on;
            },
        );
    }
}

/** What the target's surface is made from: building it anew is dear, so nothing else counts. */
function surfaceOf(state: AppState): [TargetInfo | null, EmbedResult | null, LayoutInfo | null] {
    const result = state.patchesShown ? state.result : null;
    return [state.target, result, result ? state.layout : null];
}

function describe(item: Item, { layout, landmarks, result }: AppState): string {
    if (item.kind === "vertex") {
        const landmark = landmarks?.ids[item.id];
        return (
            `Layout vertex ${item.id}` +
            (landmark === undefined ? "" : ` on target vertex ${landmark}`)
        );
    }
    const ends = layout ? [...layout.edges.subarray(2 * item.id, 2 * item.id + 2)] : [];
    const length = result?.edges[item.id]?.length;
    return (
        `Edge ${item.id}, from ${ends.join(" to ")}` +
        (length === undefined ? "" : `, ${formatLength(length)} long`)
    );
}
