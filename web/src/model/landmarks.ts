/** Where the layout vertices are on the target, while a person edits it: some may be missing. */
export interface Landmarks {
    /** Target vertex, as loaded, per layout vertex; null where it is missing. */
    readonly places: readonly (number | null)[];
    /** One per layout vertex; empty where nobody gave one. */
    readonly names: readonly string[];
    /** Where they come from, for people: "by proximity", a file name, "example". */
    readonly source: string;
}

export const noLandmarks: Landmarks = { places: [], names: [], source: "none yet" };

export function missingLandmarks(count: number, names: readonly string[] = []): Landmarks {
    return {
        places: Array.from({ length: count }, () => null),
        names: Array.from({ length: count }, (_, i) => names[i] ?? ""),
        source: "none yet",
    };
}

/** Complete landmarks. Names beyond their number are dropped, missing ones are empty. */
export function placedLandmarks(
    ids: ArrayLike<number>,
    source: string,
    names: readonly string[] = [],
): Landmarks {
    const places = Array.from(ids);
    return { places, names: places.map((_, i) => names[i] ?? ""), source };
}

/** Target vertex per layout vertex; null while one is missing. */
export function completeIds({ places }: Landmarks): Uint32Array<ArrayBuffer> | null {
    return places.length > 0 && places.every((vertex) => vertex !== null)
        ? Uint32Array.from(places)
        : null;
}

export const countPlaced = ({ places }: Landmarks): number =>
    places.filter((vertex) => vertex !== null).length;

/** The first missing landmark after `id`, around the end; null if none is missing. */
export function nextMissing({ places }: Landmarks, id: number): number | null {
    for (let step = 1; step <= places.length; ++step) {
        const at = (id + step) % places.length;
        if (places[at] === null) return at;
    }
    return null;
}

/** The landmark on a target vertex; null where there is none. */
export function landmarkOn({ places }: Landmarks, vertex: number): number | null {
    const found = places.indexOf(vertex);
    return found < 0 ? null : found;
}

/** Puts landmark `id` on a target vertex; one past the last adds a landmark. */
export function withPlace(landmarks: Landmarks, id: number, vertex: number): Landmarks {
    const places = [...landmarks.places];
    const names = [...landmarks.names];
    places[id] = vertex;
    names[id] ??= "";
    return { places, names, source: "placed by hand" };
}

export function withoutPlace(landmarks: Landmarks, id: number): Landmarks {
    const places = landmarks.places.map((vertex, i) => (i === id ? null : vertex));
    return { ...landmarks, places, source: "placed by hand" };
}

/** Takes a landmark out altogether: later ones move up. */
export function withoutLandmark(landmarks: Landmarks, id: number): Landmarks {
    const others = <Value>(list: readonly Value[]) => list.filter((_, i) => i !== id);
    return {
        places: others(landmarks.places),
        names: others(landmarks.names),
        source: "placed by hand",
    };
}

export function withName(landmarks: Landmarks, id: number, name: string): Landmarks {
    return { ...landmarks, names: landmarks.names.map((old, i) => (i === id ? name : old)) };
}

/** "3", or "3 (thumb tip)" where it has a name. */
export function landmarkLabel(landmarks: Landmarks | null, id: number): string {
    const name = landmarks?.names[id];
    return name ? `${id} (${name})` : String(id);
}
