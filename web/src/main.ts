import { examples } from "./examples/index.js";
import { Actions } from "./model/actions.js";
import { Engine } from "./model/engine.js";
import { initialState } from "./model/state.js";
import { createStore } from "./model/store.js";
import { batchPanel } from "./panels/batch.js";
import { candidatesPanel } from "./panels/candidates.js";
import { comparePanel } from "./panels/compare.js";
import { doubtsPanel } from "./panels/doubts.js";
import { downloadsPanel } from "./panels/downloads.js";
import { element } from "./panels/dom.js";
import { dropAnywhere } from "./panels/drop.js";
import { galleryPanel } from "./panels/gallery.js";
import { inputPanel } from "./panels/input.js";
import { keepWork } from "./panels/keep.js";
import { landmarksPanel } from "./panels/landmarks.js";
import { openLink } from "./panels/link.js";
import { mapPanel } from "./panels/map.js";
import { pathsPanel } from "./panels/paths.js";
import { plotPanel } from "./panels/plot.js";
import { problemsPanel } from "./panels/problems.js";
import { quadsPanel } from "./panels/quads.js";
import { resultPanel } from "./panels/result.js";
import { anotherRoute, keepRoute, routesPanel } from "./panels/routes.js";
import { shortcuts } from "./panels/shortcuts.js";
import { solvePanel, toggleSolve } from "./panels/solve.js";
import { stage } from "./panels/stage.js";
import { tabList } from "./panels/tabs.js";
import { themePanel } from "./panels/theme.js";
import { startWorker } from "./session.js";
import "./style/index.css";

// State flows one way: actions change the store, views redraw what they watch in it.
const store = createStore(initialState);
const actions = new Actions(store, new Engine(startWorker), startWorker);
const openFiles = (files: readonly File[]) => {
    if (!batchTakes(files) && !mapTakes(files)) void keep.openFiles(files);
};
const batchTakes = batchPanel(store, actions);
const mapTakes = mapPanel(store, actions);

themePanel(store, actions);
problemsPanel(store, actions);
galleryPanel(store, actions);
inputPanel(store, actions, openFiles);
landmarksPanel(store, actions);
solvePanel(store, actions);
pathsPanel(store, actions);
routesPanel(store, actions);
doubtsPanel(store, actions);
plotPanel(store, actions);
resultPanel(store, actions);
candidatesPanel(store, actions);
comparePanel(store, actions);
tabList(store, actions);
quadsPanel(store, actions);

// Without WebGL everything but the pictures still works.
let views: ReturnType<typeof stage> | null = null;
try {
    views = stage(store, actions);
} catch (error) {
    actions.report(
        new Error(
            `The 3D views cannot be shown (${error instanceof Error ? error.message : String(error)}); ` +
                "enable WebGL in the browser. Solving and downloading work without them.",
        ),
    );
}
const downloadAll = downloadsPanel(store, actions, async () => {
    if (!views) throw new Error("There is no picture without the 3D views; enable WebGL.");
    return views.screenshot();
});
const keep = keepWork(store, actions);
dropAnywhere(openFiles);
shortcuts([
    {
        key: "g",
        does: "Open the gallery",
        act: () => element("gallery-button", HTMLElement).click(),
    },
    { key: "o", does: "Open files", act: () => element("any-file", HTMLInputElement).click() },
    { key: "s", does: "Solve, or cancel", act: () => toggleSolve(store, actions) },
    { key: "n", does: "Place the next missing landmark", act: () => actions.landmarks.placeNext() },
    {
        key: "Enter",
        does: "In the target's view: place the landmark at its middle",
    },
    {
        key: "Shift+arrows",
        does: "Move the chosen landmark to a neighbouring vertex; with a map, the cursor",
    },
    { key: "Delete", does: "Take the chosen landmark off the target", act: () => views?.remove() },
    {
        key: "x",
        does: "Another route for the chosen edge",
        act: () => anotherRoute(store, actions),
    },
    { key: "k", does: "The chosen edge keeps its route", act: () => keepRoute(store, actions) },
    { key: "Escape", does: "Stop placing, choose nothing", act: () => views?.stop() },
    { key: "Ctrl+Z", does: "Undo", act: () => actions.landmarks.undo() },
    { key: "Ctrl+Shift+Z", does: "Redo", act: () => actions.landmarks.redo() },
    { key: "c", does: "Compare with the heuristics", act: () => void actions.compare() },
    {
        key: "a",
        does: "Paths of edges alone, with their conflicts",
        act: () => void actions.toggleCandidates(),
    },
    { key: "1", does: "The embedding's controls", act: () => actions.openTab("embedding") },
    { key: "2", does: "Quad mesh", act: () => actions.openTab("quads") },
    { key: "3", does: "Map to a second target", act: () => actions.openTab("map") },
    { key: "d", does: "Download the three result files", act: downloadAll },
    { key: "f", does: "Fit the view", act: () => views?.fit() },
    { key: "r", does: "Reset the view", act: () => views?.reset() },
    { key: "p", does: "Show or hide patches", act: () => toggle("patchesShown") },
    { key: "w", does: "Wireframe on or off", act: () => toggle("wireframe") },
    { key: "l", does: "Show or hide the layout", act: () => toggle("layoutShown") },
    { key: "Arrows", does: "Turn a 3D view that has the focus" },
    { key: "+ −", does: "Nearer, farther" },
]);

function toggle(field: "patchesShown" | "wireframe" | "layoutShown"): void {
    actions.show({ [field]: !store.get().display[field] });
}

void (async () => {
    const [first] = examples;
    if (!(await openLink(actions)) && !(await keep.restore()) && first)
        await actions.openExample(first);
    keep.start();
})();
