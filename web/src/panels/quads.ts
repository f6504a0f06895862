import type { QuadMesh } from "layout-embedding";
import type { Actions } from "../model/actions.js";
import { formatCount, formatFigure, formatLength, formatWhole } from "../model/describe.js";
import { guessedEdgeLength, loopGroups, type LoopGroup, type QuadState } from "../model/quads.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import { create, download, element, figureRows, setText } from "./dom.js";
import { tabWords } from "./tabs.js";

/** Settings and figures of the quad mesh that the target's view shows. */
export function quadsPanel(store: Store<AppState>, actions: Actions): void {
    const density = element("density", HTMLInputElement);
    const length = element("edge-length", HTMLInputElement);
    let usual = 1;
    // Four times as many quads a step.
    density.addEventListener("input", () =>
        actions.quadMesh.setEdgeLength(Number((usual / 2 ** density.valueAsNumber).toPrecision(4))),
    );
    length.addEventListener("change", () => {
        const wanted = length.valueAsNumber;
        if (wanted > 0) actions.quadMesh.setEdgeLength(wanted);
        else if (length.value === "") actions.quadMesh.setEdgeLength(null);
    });
    // Only a mesh says what the package's own edge length is; until there is one, a guess.
    store.watch(
        (state) => [state.target],
        (target) => {
            usual = target ? guessedEdgeLength(target) : 1;
        },
    );
    store.watch(
        (state) => [state.target, state.quadMesh.edgeLength, state.quadMesh.mesh],
        (_, edgeLength, mesh) => {
            usual = mesh?.defaultEdgeLength ?? usual;
            const shown = edgeLength ?? usual;
            length.value = String(Number(shown.toPrecision(4)));
            density.value = String(Math.log2(usual / shown));
            density.setAttribute("aria-valuetext", `edges ${formatLength(shown)} long`);
        },
    );
    element("quads-stop", HTMLButtonElement).addEventListener("click", () => {
        actions.quadMesh.stop();
        density.focus();
    });
    const bar = element("quads-progress", HTMLProgressElement);
    const save = element("quads-obj", HTMLButtonElement);
    save.addEventListener("click", () => {
        const { mesh } = store.get().quadMesh;
        if (mesh)
            download("quads.obj", new Blob([new Uint8Array(mesh.obj)], { type: "model/obj" }));
    });
    store.watch(
        (state) => [state.quadMesh, state.result, state.activity?.phase],
        (quads, ..._others) => {
            const missing = "Quads need an embedding: solve first.";
            setText("quads-status", tabWords(store.get(), stateWords(quads), missing));
            element("quads-running", HTMLElement).hidden = quads.phase === null;
            if (quads.progress === null) bar.removeAttribute("value");
            else bar.value = quads.progress;
            save.disabled = !quads.mesh;
        },
    );
    store.watch(
        (state) => [state.quadMesh.mesh],
        (mesh) => {
            element("quad-figures", HTMLElement).replaceChildren(
                ...figureRows(mesh ? figuresOf(mesh) : []),
            );
        },
    );
    loopTable(store, actions);
}

function stateWords({ mesh, phase, error, isRelaxed }: QuadState): string {
    if (error) return error;
    if (phase) return `${phase} …`;
    if (!mesh) return "";
    const count = formatCount(mesh.quads.length / 4, "quad");
    return isRelaxed ? `${count}, evened out on the surface.` : `${count}, not evened out.`;
}

function figuresOf({ statistics, quads }: QuadMesh): [string, string][] {
    const { leastAngle, largestAngle, angleDeviation, leastEdge, meanEdge, largestEdge } =
        statistics;
    const number = (value: number, digits: number) => value.toFixed(digits);
    return [
        ["Quads", formatWhole(quads.length / 4)],
        ["Flipped", formatWhole(statistics.flipped)],
        ["Least scaled Jacobian", number(statistics.leastJacobian, 3)],
        ["Mean scaled Jacobian", number(statistics.meanJacobian, 3)],
        ["Angles", `${number(leastAngle, 1)}° to ${number(largestAngle, 1)}°`],
        ["Deviation from 90°", `${number(angleDeviation, 1)}°`],
        ["Mean edge length", formatFigure(meanEdge)],
        ["Shortest to longest", `${formatFigure(leastEdge)} to ${formatFigure(largestEdge)}`],
    ];
}

/** How many segments each loop has, and inputs to say how many it shall have. */
function loopTable(store: Store<AppState>, actions: Actions): void {
    const details = element("loops", HTMLDetailsElement);
    const rows = element("loop-rows", HTMLElement);
    const fill = () => {
        const { mesh, segments } = store.get().quadMesh;
        details.hidden = !mesh;
        if (!mesh || !details.open) return rows.replaceChildren();
        const { activeElement } = document;
        const focused = rows.contains(activeElement) ? activeElement?.id : null;
        const given = new Map(segments);
        rows.replaceChildren(
            ...loopGroups(mesh).map((group) => loopRow(group, given, mesh.subdivided, actions)),
        );
        if (focused) document.getElementById(focused)?.focus();
    };
    details.addEventListener("toggle", fill);
    store.watch(
        (state) => [state.quadMesh.mesh, state.quadMesh.segments, state.quadMesh.error],
        fill,
    );
}

function loopRow(
    { edges, segments }: LoopGroup,
    given: ReadonlyMap<number, number>,
    even: boolean,
    actions: Actions,
): HTMLElement {
    const line = create("tr");
    const ruled = edges.find((edge) => given.has(edge));
    const head = create("th");
    head.scope = "row";
    const show = create("button", edges.join(", "), "plain");
    show.type = "button";
    show.setAttribute(
        "aria-label",
        `Show edge ${edges[0]}, of the loop of edges ${edges.join(", ")}`,
    );
    show.addEventListener("click", () => actions.select({ kind: "edge", id: edges[0]! }));
    head.append(show);
    const input = create("input");
    input.type = "number";
    input.id = `segments-${edges[0]}`;
    input.min = input.step = even ? "2" : "1";
    input.value = String(ruled === undefined ? segments : given.get(ruled));
    input.setAttribute("aria-label", `Segments of edges ${edges.join(", ")}`);
    input.addEventListener("change", () => {
        const wanted = input.valueAsNumber;
        if (Number.isInteger(wanted) && wanted > 0)
            actions.quadMesh.setSegments(ruled ?? edges[0]!, wanted);
    });
    const reset = create("button", "Reset", "plain");
    reset.type = "button";
    reset.hidden = ruled === undefined;
    reset.setAttribute("aria-label", `Segments of edges ${edges.join(", ")} by density`);
    reset.addEventListener("click", () => {
        if (ruled !== undefined) actions.quadMesh.setSegments(ruled, null);
        document.getElementById(input.id)?.focus();
    });
    const [cell, last] = [create("td"), create("td")];
    cell.append(input);
    last.append(reset);
    line.append(head, cell, last);
    return line;
}
