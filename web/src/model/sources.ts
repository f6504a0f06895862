// Where layouts and targets come from.
import type { MeshInput } from "layout-embedding";

/** The same file or arrays can be read again: file contents are fetched each time. */
export type Source = File | MeshInput;
export type Role = "layout" | "target";

/** A second target, to be opened again: a shape of the gallery, or a mesh and maybe landmarks. */
export type SavedSecond = { readonly shape: string } | { readonly files: readonly File[] };

export const nameOf = (source: Source): string => source.name ?? "mesh";

export async function inputOf(source: Source): Promise<MeshInput> {
    return source instanceof File
        ? { name: source.name, bytes: await source.arrayBuffer() }
        : source;
}
