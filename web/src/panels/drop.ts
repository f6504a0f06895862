import { element } from "./dom.js";

/** Files may be dropped anywhere on the page. */
export function dropAnywhere(open: (files: readonly File[]) => void): void {
    const veil = element("drop-target", HTMLElement);
    // dragleave also fires between elements: the depth tells when the pointer has left the page.
    let depth = 0;
    const carriesFiles = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
    addEventListener("dragenter", (event) => {
        if (!carriesFiles(event)) return;
        event.preventDefault();
        depth += 1;
        veil.hidden = false;
    });
    addEventListener("dragleave", (event) => {
        if (!carriesFiles(event)) return;
        depth -= 1;
        if (depth <= 0) veil.hidden = true;
    });
    addEventListener("dragover", (event) => {
        if (carriesFiles(event)) event.preventDefault();
    });
    addEventListener("drop", (event) => {
        depth = 0;
        veil.hidden = true;
        if (!carriesFiles(event)) return;
        event.preventDefault();
        open([...(event.dataTransfer?.files ?? [])]);
    });
}
