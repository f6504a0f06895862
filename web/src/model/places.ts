import type { LayoutInfo, UncheckedMesh } from "layout-embedding";
import type { Landmarks } from "./landmarks.js";
import type { Place } from "./state.js";

/** The places that an error of the package names, by what they are; empty for other errors. */
function details(error: unknown): Readonly<Record<string, number>> {
    return error instanceof Error && "details" in error
        ? (error.details as Readonly<Record<string, number>>)
        : {};
}

function numbers(error: unknown, ...names: readonly string[]): number[] {
    const found = details(error);
    return names.map((name) => found[name]).filter((value) => value !== undefined);
}

/** Where in a mesh an error lies; null where it does not say, or the mesh cannot even be read. */
export async function meshPlace(
    error: unknown,
    role: "layout" | "target",
    name: string,
    read: () => Promise<UncheckedMesh>,
): Promise<Place | null> {
    const vertices = numbers(error, "vertex", "otherVertex");
    const faces = numbers(error, "face", "otherFace");
    if (vertices.length + faces.length === 0) return null;
    const mesh = await read().catch(() => null);
    return mesh && { kind: "mesh", role, name, mesh, vertices, faces };
}

/** The layout edge that an error is about; null if it is about none. */
export const edgeOf = (error: unknown): number | null => numbers(error, "edge")[0] ?? null;

/**
 * The landmarks that an error is about, or those at the ends of its edge, where they are on the
 * target; null if it is about none.
 */
export function landmarksOf(
    error: unknown,
    landmarks: Landmarks | null,
    layout: LayoutInfo | null,
): Place | null {
    const edge = edgeOf(error);
    const ends = edge === null ? [] : [...(layout?.edges.subarray(2 * edge, 2 * edge + 2) ?? [])];
    const ids = [...numbers(error, "landmark", "otherLandmark"), ...ends].filter(
        (id) => (landmarks?.places[id] ?? null) !== null,
    );
    return ids.length > 0 ? { kind: "landmarks", ids } : null;
}

/** Longer lines are cut. */
const longestLine = 120;
/** Larger files are not searched for a line. */
const largestText = 1e8;

/** The line of a text file that an error is about; null if it is about none. */
export async function lineOf(error: unknown, file: File): Promise<string | null> {
    const [number] = numbers(error, "line");
    if (number === undefined || file.size > largestText) return null;
    const text = (await file.text()).split("\n", number)[number - 1]?.trim();
    if (!text) return null;
    return text.length > longestLine ? `${text.slice(0, longestLine)} …` : text;
}
