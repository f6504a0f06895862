import { createSession } from "./session.js";
import { examples } from "./examples/index.js";
import { Actions } from "./model/actions.js";
import { Engine } from "./model/engine.js";
import { initialState } from "./model/state.js";
import { createStore } from "./model/store.js";
import { downloadsPanel } from "./panels/downloads.js";
import { element } from "./panels/dom.js";
import { dropAnywhere } from "./panels/drop.js";
import { inputPanel } from "./panels/input.js";
import { problemsPanel } from "./panels/problems.js";
import { resultPanel } from "./panels/result.js";
import { shortcuts } from "./panels/shortcuts.js";
import { solvePanel, toggleSolve } from "./panels/solve.js";
import { stage } from "./panels/stage.js";
import "./style.css";

// State flows one way: actions change the store, views redraw what they watch in it.
const store = createStore(initialState);
const actions = new Actions(store, new Engine(createSession));

problemsPanel(store, actions);
inputPanel(store, actions);
solvePanel(store, actions);
resultPanel(store, actions);

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
const openFiles = (files: readonly File[]) => {
    element("example", HTMLSelectElement).value = "";
    void actions.openFiles(files);
};
dropAnywhere(openFiles);
shortcuts({
    o: () => element("any-file", HTMLInputElement).click(),
    s: () => toggleSolve(store, actions),
    d: downloadAll,
    r: () => views?.resetView(),
    l: () => actions.show({ layoutShown: !store.get().layoutShown }),
});

const [first] = examples;
if (first) void actions.openExample(first);
