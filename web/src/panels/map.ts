import { mapFiles } from "layout-embedding/worker";
import type { SurfaceMap } from "layout-embedding";
import { loadShapes } from "../gallery/catalogue.js";
import type { Actions } from "../model/actions.js";
import { nearestVertex, placeOf, type FacePoint } from "../model/correspondence.js";
import { formatCount, formatFigure } from "../model/describe.js";
import { shownTexture, textures, type MapState, type Texture } from "../model/maps.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import { create, download, element, figureRows, setText } from "./dom.js";
import { zipped } from "./downloads.js";
import { tabWords } from "./tabs.js";

const textureNames: Record<Texture, string> = {
    grid: "Colours and a grid",
    checker: "Checkers",
    patches: "Patches",
    distortion: "Distortion",
    file: "Texture coordinates of the file",
};

const textureTexts: Record<Texture, string> = {
    grid: "By the place on the first target: what has the same colour corresponds.",
    checker: "Cells around the first target: squares there show what the map does to them.",
    patches: "The layout's faces; the optimised map moves their borders.",
    file: "Checkers in the texture coordinates of the first target's file, which go along with the overlays.",
    distortion: "From light (as it is) to dark (an energy of 64 and more).",
};

/** The second target, the map to it, its figures and files; returns what takes dropped files. */
export function mapPanel(
    store: Store<AppState>,
    actions: Actions,
): (files: readonly File[]) => boolean {
    const { map: mapping } = actions;
    const take = (files: readonly File[]) => {
        if (store.get().tab !== "map" || files.some(({ name }) => /\.zip$/i.test(name)))
            return false;
        mapping.chooseFiles(files);
        return true;
    };
    const input = element("map-files", HTMLInputElement);
    input.addEventListener("change", () => {
        const files = [...(input.files ?? [])];
        input.value = "";
        if (files.length > 0) take(files);
    });
    shapesOfTheClass(store, actions);
    textureChoice(store, actions);
    progressOf(store, actions);
    points(store, actions);
    files(store, actions);
    store.watch(
        (state) => [state.map.map, state.map.optimised],
        (map, optimised) => {
            element("map-figures", HTMLElement).replaceChildren(
                ...figureRows(map ? figuresOf(map, optimised !== "no") : []),
            );
        },
    );
    store.watch(
        (state) => [state.tab],
        (tab) =>
            setText(
                "drop-text",
                tab === "map"
                    ? "Drop the second target and its landmarks"
                    : "Drop a layout, a target, landmarks: in any order",
            ),
    );
    return take;
}

/** A button for each other shape of the gallery's class that is open. */
function shapesOfTheClass(store: Store<AppState>, actions: Actions): void {
    const group = element("map-shapes", HTMLElement);
    const fill = async (id: string | null) => {
        const shapes = id === null ? [] : await loadShapes();
        const family = shapes.find((shape) => shape.id === id)?.family;
        const others = shapes.filter((shape) => shape.family === family && shape.id !== id);
        group.hidden = others.length === 0;
        group.replaceChildren(
            ...others.map((shape) => {
                const button = create("button", shape.title, "primary");
                button.type = "button";
                button.addEventListener("click", () => actions.map.chooseShape(shape));
                return button;
            }),
        );
    };
    store.watch(
        (state) => [state.origin],
        (origin) => {
            fill(origin?.kind === "shape" ? origin.name : null).catch((error: unknown) =>
                actions.report(error),
            );
        },
    );
}

function textureChoice(store: Store<AppState>, actions: Actions): void {
    const select = element("texture", HTMLSelectElement);
    select.append(...textures.map((name) => new Option(textureNames[name], name)));
    select.addEventListener("change", () => {
        const chosen = textures.find((name) => name === select.value);
        if (chosen) actions.map.setTexture(chosen);
    });
    store.watch(
        (state) => [shownTexture(state.map), state.map.coordinates !== null],
        (texture, hasCoordinates) => {
            const own = select.querySelector<HTMLOptionElement>("option[value=file]")!;
            own.hidden = own.disabled = !hasCoordinates;
            select.value = texture;
            setText("texture-text", textureTexts[texture]);
        },
    );
}

function progressOf(store: Store<AppState>, actions: Actions): void {
    const running = element("map-running", HTMLElement);
    const bar = element("map-progress", HTMLProgressElement);
    const again = element("map-again", HTMLButtonElement);
    again.addEventListener("click", () => {
        actions.map.again();
        element("map-stop", HTMLElement).focus();
    });
    element("map-stop", HTMLButtonElement).addEventListener("click", () => {
        actions.map.stop();
        again.focus();
    });
    store.watch(
        (state) => [state.map, state.result, state.activity?.phase],
        (map, result, ..._others) => {
            const missing = "A map needs an embedding in the first target: solve first.";
            setText("map-status", tabWords(store.get(), stateWords(map), missing));
            running.hidden = map.phase === null;
            if (map.progress === null) bar.removeAttribute("value");
            else bar.value = map.progress;
            again.hidden =
                !result?.refined || !map.other || map.phase !== null || map.optimised === "yes";
        },
    );
}

const optimisedWords = { no: "not optimised", partly: "partly optimised", yes: "optimised" };

function stateWords({ other, map, phase, error, optimised }: MapState): string {
    if (error) return error;
    if (phase) return `${phase} …`;
    if (!other) return "";
    if (!map) return `Stopped before there was a map to ${other.title}.`;
    const size = formatCount(map.overlay.patches.length, "common triangle");
    return `Mapped to ${other.title}, ${optimisedWords[optimised]}: ${size}.`;
}

function figuresOf(map: SurfaceMap, isOptimised: boolean): [string, string][] {
    const { distortion: now, firstDistortion: first } = map;
    const row = (name: string, key: keyof typeof now): [string, string] => [
        name,
        formatFigure(now[key]) + (isOptimised ? ` (from ${formatFigure(first[key])})` : ""),
    ];
    return [
        row("Mean energy", "meanEnergy"),
        row("Largest energy", "largestEnergy"),
        row("Mean stretch ratio", "meanConformal"),
        row("Mean area ratio", "meanArea"),
    ];
}

/** Where the cursor is, and an input that puts it on a vertex. */
function points(store: Store<AppState>, actions: Actions): void {
    const vertex = element("map-vertex", HTMLInputElement);
    vertex.addEventListener("change", () => {
        if (Number.isInteger(vertex.valueAsNumber))
            actions.map.pointAtVertex("a", vertex.valueAsNumber);
    });
    store.watch(
        (state) => [state.map.cursor, state.map.target, state.target],
        (cursor, second, first) => {
            if (document.activeElement !== vertex)
                vertex.value =
                    cursor?.from === "a" && cursor.vertex !== null ? String(cursor.vertex) : "";
            const describe = (target: AppState["target"], point: FacePoint | null): string => {
                if (!target || !point) return "–";
                const place = placeOf(target, point).map((x) => formatFigure(x));
                return `near vertex ${nearestVertex(target, point)} (${place.join(", ")})`;
            };
            element("map-points", HTMLElement).replaceChildren(
                ...figureRows([
                    ["First", describe(first, cursor?.a ?? null)],
                    ["Second", describe(second, cursor?.b ?? null)],
                ]),
            );
        },
    );
}

function files(store: Store<AppState>, actions: Actions): void {
    const buttons = [
        ...document.querySelectorAll<HTMLButtonElement>("button[data-map-file]"),
        element("map-zip", HTMLButtonElement),
    ];
    for (const button of buttons)
        button.addEventListener("click", () => {
            const { map, coordinates } = store.get().map;
            if (!map) return;
            const all: Readonly<Record<string, Uint8Array>> = mapFiles(map, coordinates);
            const name = button.dataset["mapFile"];
            const bytes = name === undefined ? undefined : all[name];
            if (name !== undefined && bytes) download(name, new Blob([new Uint8Array(bytes)]));
            else
                zipped(all).then(
                    (zip) => download("map.zip", zip),
                    (error: unknown) => actions.report(error),
                );
        });
    store.watch(
        (state) => [state.map.map],
        (map) => {
            for (const button of buttons) button.disabled = !map;
        },
    );
}
