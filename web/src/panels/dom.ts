/** The element with this id; the page's own markup guarantees that it is there. */
export function element<Type extends HTMLElement>(id: string, type: new () => Type): Type {
    const found = document.getElementById(id);
    if (!(found instanceof type)) throw new Error(`the page has no ${type.name} #${id}`);
    return found;
}

export function setText(id: string, text: string): void {
    const target = element(id, HTMLElement);
    if (target.textContent !== text) target.textContent = text;
}

/** A new element with text. */
export function create<Tag extends keyof HTMLElementTagNameMap>(
    tag: Tag,
    text = "",
    className = "",
): HTMLElementTagNameMap[Tag] {
    const made = document.createElement(tag);
    made.textContent = text;
    if (className) made.className = className;
    return made;
}

/** Names and values as the rows of a list of figures. */
export function figureRows(figures: readonly (readonly [string, string])[]): HTMLElement[] {
    return figures.map(([name, value]) => {
        const row = create("div");
        row.append(create("dt", name), create("dd", value));
        return row;
    });
}

/** Hands bytes to the browser's downloads. */
export function download(name: string, content: Blob): void {
    const url = URL.createObjectURL(content);
    const link = create("a");
    link.href = url;
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(url), 60_000);
}
