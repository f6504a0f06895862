import { element } from "./dom.js";

const typing = "input:not([type=checkbox]):not([type=file]), textarea, select, [contenteditable]";

/** Single-key shortcuts. They rest while something is typed or a dialog is open. */
export function shortcuts(keys: Readonly<Record<string, () => void>>): void {
    const help = element("help", HTMLDialogElement);
    const showHelp = () => help.showModal();
    element("help-button", HTMLButtonElement).addEventListener("click", showHelp);
    addEventListener("keydown", (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey || event.repeat || help.open) return;
        if (event.target instanceof Element && event.target.matches(typing)) return;
        const action = event.key === "?" ? showHelp : keys[event.key.toLowerCase()];
        if (!action) return;
        event.preventDefault();
        action();
    });
}
