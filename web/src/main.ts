import { createSession } from "./session";
import { examples } from "./examples/index";
import { Actions } from "./model/actions";
import { Engine } from "./model/engine";
import { initialState } from "./model/state";
import { createStore } from "./model/store";
import { downloadsPanel } from "./panels/downloads";
import { element } from "./panels/dom";
import { dropAnywhere } from "./panels/drop";
import { inputPanel } from "./panels/input";
import { problemsPanel } from "./panels/problems";
import { resultPanel } from "./panels/result";
import { shortcuts } from "./panels/shortcuts";
import { solvePanel, toggleSolve } from "./panels/solve";
import { stage } from "./panels/stage";
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
