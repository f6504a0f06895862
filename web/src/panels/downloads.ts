import { strToU8, zip, type Zippable } from "fflate";
import type { ExportFormat } from "layout-embedding";
import type { Actions } from "../model/actions.js";
import { landmarkFile } from "../model/landmark_file.js";
import { completeIds } from "../model/landmarks.js";
import { objOf, packSession } from "../model/session_file.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import { download, element } from "./dom.js";
import { linkTo } from "./link.js";

/** Buttons for files, a picture, the session and a link; returns what the shortcut does. */
export function downloadsPanel(
    store: Store<AppState>,
    actions: Actions,
    screenshot: () => Promise<Blob>,
): () => void {
    const deliver = (files: Readonly<Record<string, Uint8Array>>) => {
        for (const [name, bytes] of Object.entries(files))
            download(name, new Blob([new Uint8Array(bytes)], { type: typeOf(name) }));
    };
    const buttons = [
        ...document.querySelectorAll<HTMLButtonElement>("button[data-file], button[data-format]"),
    ];
    for (const button of buttons)
        button.addEventListener("click", () => {
            const { file, format } = button.dataset;
            const wanted = singleFormats.find((name) => name === format);
            if (wanted) void actions.exportFormats([wanted]).then(deliver);
            else
                void actions.exportFiles().then((files) => {
                    const bytes = files[file ?? ""];
                    if (bytes) deliver({ [file ?? ""]: bytes });
                });
        });
    const onClick = (id: string, act: () => Promise<void>) => {
        const button = element(id, HTMLButtonElement);
        button.addEventListener("click", () => {
            act().catch((error: unknown) => actions.report(error));
        });
        return button;
    };
    const all = onClick("download-all", async () => {
        const { landmarks, target, quadMesh } = store.get();
        const files: Zippable = {
            ...(await actions.exportFiles()),
            ...(await actions.exportFormats(singleFormats)),
        };
        const ids = landmarks && completeIds(landmarks);
        if (ids && target) files["landmarks.txt"] = strToU8(landmarkFile(ids, target));
        if (quadMesh.mesh) files["quads.obj"] = quadMesh.mesh.obj;
        // A layout that was made here is nowhere else.
        const { layout } = actions.saved();
        if (layout && "corners" in layout) files["layout.obj"] = objOf(layout);
        download("embedding.zip", await zipped(files));
    });
    for (const button of document.querySelectorAll<HTMLButtonElement>("button[data-picture]"))
        button.addEventListener("click", () => {
            screenshot().then(
                (picture) => download(button.dataset["picture"]!, picture),
                (error: unknown) => actions.report(error),
            );
        });
    const session = onClick("save-session", async () =>
        download("session.zip", await zipped(await packSession(actions.saved()))),
    );
    const link = onClick("copy-link", async () => {
        const address = linkTo(store.get());
        if (!address) return;
        await navigator.clipboard.writeText(address);
        actions.notice("The link is in the clipboard.");
    });
    store.watch(
        (state) => [state.result, state.target, state.origin],
        (result, target, origin) => {
            for (const button of [...buttons, all]) button.disabled = !result?.refined;
            session.disabled = !target;
            link.disabled = !origin;
            link.title = origin ? "" : "Only examples and shapes of the gallery have links.";
        },
    );
    return () => {
        if (store.get().result?.refined) void actions.exportFiles().then(deliver);
    };
}

export function zipped(files: Zippable): Promise<Blob> {
    return new Promise((resolve, reject) => {
        zip(files, (error, bytes) => {
            if (error) reject(error);
            else resolve(new Blob([new Uint8Array(bytes)], { type: "application/zip" }));
        });
    });
}

/** The formats of other programs, each one file. */
const singleFormats: readonly ExportFormat[] = ["ply", "vtp", "glb", "svg"];

const types: Partial<Record<string, string>> = {
    json: "application/json",
    obj: "model/obj",
    glb: "model/gltf-binary",
    svg: "image/svg+xml",
};

const typeOf = (name: string): string =>
    types[name.slice(name.lastIndexOf(".") + 1)] ?? "application/octet-stream";
