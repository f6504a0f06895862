// Where layouts and targets come from, and what of a person's work can be put away.
import type { MeshInput } from "layout-embedding";
import type { Landmarks } from "./landmarks.js";
import type { RouteRule } from "./routes.js";
import type { AppState, Origin } from "./state.js";

/** The same file or arrays can be read again: file contents are fetched each time. */
export type Source = File | MeshInput;
export type Role = "layout" | "target";

/** A second target, to be opened again: a shape of the gallery, or a mesh and maybe landmarks. */
export type SavedSecond = { readonly shape: string } | { readonly files: readonly File[] };

/** What can be put away and opened again. */
export interface SavedWork {
    readonly layout: Source | null;
    readonly target: Source | null;
    readonly landmarks: Landmarks | null;
    readonly making: boolean;
    readonly quads: boolean;
    readonly repair: boolean;
    readonly options: AppState["options"];
    readonly origin: Origin | null;
    readonly routes: readonly RouteRule[];
    /** What the target is mapped to. */
    readonly second: SavedSecond | null;
    /** Whether there was an embedding: then it is looked for again. */
    readonly solved: boolean;
}

export const nameOf = (source: Source): string => source.name ?? "mesh";

export async function inputOf(source: Source): Promise<MeshInput> {
    return source instanceof File
        ? { name: source.name, bytes: await source.arrayBuffer() }
        : source;
}
