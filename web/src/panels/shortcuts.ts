import { create, element } from "./dom.js";

const typing =
    "input:not([type=checkbox]):not([type=file]):not([type=range]), textarea, select, [contenteditable]";

export interface Shortcut {
    /** As KeyboardEvent.key names it, with Ctrl+ and Shift+ before it; shown in the list of keys. */
    readonly key: string;
    readonly does: string;
    /** Left out where a view handles the key itself. */
    readonly act?: () => void;
}

/** Shortcuts and their list. They rest while something is typed or a dialog is open. */
export function shortcuts(keys: readonly Shortcut[]): void {
    const help = element("help", HTMLDialogElement);
    const showHelp = () => help.showModal();
    const all = [...keys, { key: "?", does: "This list", act: showHelp }];
    element("keys", HTMLElement).replaceChildren(...all.map(row));
    element("help-button", HTMLButtonElement).addEventListener("click", showHelp);
    addEventListener("keydown", (event) => {
        if (event.altKey || event.defaultPrevented) return;
        if (document.querySelector("dialog[open]")) return;
        if (event.target instanceof Element && event.target.matches(typing)) return;
        const control = event.ctrlKey || event.metaKey;
        const letter = event.key.length === 1 ? event.key.toUpperCase() : event.key;
        const name =
            (control ? "Ctrl+" : "") + (control && event.shiftKey ? "Shift+" : "") + letter;
        const wanted = name === "Ctrl+Y" ? "Ctrl+Shift+Z" : name === "Backspace" ? "Delete" : name;
        // Single letters must not fire again and again; steps back and forth may.
        if (event.repeat && !control) return;
        const found = all.find(({ key }) => key.toUpperCase() === wanted.toUpperCase());
        if (!found?.act) return;
        event.preventDefault();
        found.act();
    });
}

function row({ key, does }: Shortcut): HTMLElement {
    const line = create("div");
    const head = create("dt");
    const separated =
        key === "?" || !key.includes("+") || key.startsWith("+") ? key.split(" ") : key.split("+");
    separated.forEach((part, i) => {
        if (i > 0) head.append(" ");
        head.append(create("kbd", part.length === 1 ? part.toUpperCase() : part));
    });
    line.append(head, create("dd", does));
    return line;
}
