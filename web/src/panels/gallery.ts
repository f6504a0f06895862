import { examples } from "../examples/index.js";
import { loadShapes, type Shape } from "../gallery/catalogue.js";
import type { Actions } from "../model/actions.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import { create, element } from "./dom.js";

/** A dialog with the project's own shapes, and the choice among those of one class. */
export function galleryPanel(store: Store<AppState>, actions: Actions): void {
    const dialog = element("gallery", HTMLDialogElement);
    const list = element("gallery-cards", HTMLElement);
    const choose = (open: () => Promise<void>) => {
        dialog.close();
        void open();
    };
    element("gallery-button", HTMLButtonElement).addEventListener("click", () => {
        dialog.showModal();
        if (list.childElementCount > 0) return;
        loadShapes().then(
            (shapes) => list.replaceChildren(...cards(shapes, actions, choose)),
            (error: unknown) => {
                dialog.close();
                actions.report(error);
            },
        );
    });
    familyRow(store, actions);
}

function cards(
    shapes: readonly Shape[],
    actions: Actions,
    choose: (open: () => Promise<void>) => void,
): HTMLElement[] {
    const card = (title: string, note: string, picture: string, open: () => Promise<void>) => {
        const button = create("button", "", "shape");
        button.type = "button";
        const image = create("img");
        image.src = picture;
        image.alt = "";
        image.loading = "lazy";
        image.width = 240;
        image.height = 180;
        image.addEventListener("error", () => image.remove());
        button.append(image, create("strong", title), create("span", note, "soft"));
        button.addEventListener("click", () => choose(open));
        return button;
    };
    return [
        ...shapes.map((shape) =>
            card(
                shape.title,
                shape.topology ? `${shape.familyTitle}, ${shape.topology}` : shape.familyTitle,
                shape.picture,
                () => actions.openShape(shape),
            ),
        ),
        ...examples.map((example) =>
            card(
                example.title,
                example.description,
                new URL(`shapes/examples/${example.name}.webp`, document.baseURI).href,
                () => actions.openExample(example),
            ),
        ),
    ];
}

/** The other shapes of the class that is open: the same layout fits into each. */
function familyRow(store: Store<AppState>, actions: Actions): void {
    const row = element("family-row", HTMLElement);
    const select = element("family", HTMLSelectElement);
    let members: readonly Shape[] = [];
    select.addEventListener("change", () => {
        const shape = members.find(({ id }) => id === select.value);
        if (shape) void actions.openShape(shape, true);
    });
    const fill = (id: string | null, shapes: readonly Shape[]) => {
        const family = shapes.find((shape) => shape.id === id)?.family;
        members = shapes.filter((shape) => shape.family === family);
        select.replaceChildren(...members.map((shape) => new Option(shape.title, shape.id)));
        select.value = id ?? "";
        row.hidden = members.length < 2;
    };
    store.watch(
        (state) => [state.origin],
        (origin) => {
            const id = origin?.kind === "shape" ? origin.name : null;
            if (id === null) fill(null, []);
            else loadShapes().then((shapes) => fill(id, shapes), actions.report.bind(actions));
        },
    );
}
