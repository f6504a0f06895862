/** What a quick look at a dropped file tells. */
export interface Sighting {
    readonly file: File;
    readonly kind: "mesh" | "landmarks";
    readonly vertices: number;
    /** Whether a face has more than three corners; targets never do. */
    readonly polygons: boolean;
}

type Look = Pick<Sighting, "vertices" | "polygons">;

const landmarkEndings = new Set(["txt", "vts", "json", "pp"]);

/** Formats that say at their beginning how large they are. */
const quickLooks: Record<string, (file: File) => Promise<Look>> = {
    off: lookAtOff,
    ply: lookAtPly,
    stl: lookAtStl,
    glb: lookAtGlb,
};

const newline = 10;
const space = 32;
const tab = 9;

/**
 * Counts the vertices of a mesh file and looks for polygons, piece by piece, without keeping the
 * content. What cannot be understood counts as a mesh: the core then says what is wrong with it.
 */
export async function look(file: File): Promise<Sighting> {
    const extension = /\.([^.]*)$/.exec(file.name)?.[1]?.toLowerCase() ?? "";
    if (landmarkEndings.has(extension))
        return { file, kind: "landmarks", vertices: 0, polygons: false };
    const quickLook = quickLooks[extension];
    if (quickLook) return { file, kind: "mesh", ...(await quickLook(file)) };

    let vertices = 0;
    let polygons = false;
    // The state between two pieces: the line's first letter, and its number of words so far.
    let first = 0;
    let second = 0;
    let column = 0;
    let words = 0;
    let inWord = false;
    const endLine = () => {
        if (first === 0x76 && second <= space) ++vertices;
        if (first === 0x66 && words > 4) polygons = true;
        first = second = column = words = 0;
        inWord = false;
    };
    const reader = file.stream().getReader();
    for (;;) {
        const { done, value } = await reader.read();
        if (done) break;
        for (const byte of value) {
            if (byte === newline) {
                endLine();
                continue;
            }
            const blank = byte === space || byte === tab || byte === 13;
            if (!blank && !inWord) ++words;
            inWord = !blank;
            if (column === 0) first = byte;
            else if (column === 1) second = byte;
            ++column;
        }
    }
    endLine();
    return { file, kind: "mesh", vertices, polygons };
}

async function lookAtOff(file: File): Promise<Look> {
    const head = (await file.slice(0, 4096).text()).replace(/#.*/g, "");
    const vertices = Number(/(\d+)\s+\d+\s+\d+/.exec(head)?.[1] ?? 0);
    return { vertices, polygons: false };
}

async function lookAtPly(file: File): Promise<Look> {
    const head = await file.slice(0, 16384).text();
    const vertices = Number(/element vertex (\d+)/.exec(head)?.[1] ?? 0);
    return { vertices, polygons: false };
}

/** Two triangles make a vertex, about, and in text 250 characters a triangle. */
async function lookAtStl(file: File): Promise<Look> {
    const head = new DataView(await file.slice(0, 84).arrayBuffer());
    const count = head.byteLength === 84 ? head.getUint32(80, true) : 0;
    const isBinary = file.size === 84 + 50 * count;
    return { vertices: Math.round(isBinary ? count / 2 : file.size / 500), polygons: false };
}

interface GlbDocument {
    readonly accessors?: readonly { readonly count?: number }[];
    readonly meshes?: readonly {
        readonly primitives?: readonly {
            readonly attributes?: { readonly POSITION?: number };
        }[];
    }[];
}

async function lookAtGlb(file: File): Promise<Look> {
    const head = new DataView(await file.slice(0, 20).arrayBuffer());
    const length = head.byteLength === 20 ? head.getUint32(12, true) : 0;
    let vertices = 0;
    try {
        const { accessors, meshes } = JSON.parse(
            await file.slice(20, 20 + length).text(),
        ) as GlbDocument;
        for (const { primitives } of meshes ?? [])
            for (const { attributes } of primitives ?? [])
                vertices += accessors?.[attributes?.POSITION ?? -1]?.count ?? 0;
    } catch {
        // The core will say what is wrong with it.
    }
    return { vertices, polygons: false };
}

export interface Roles {
    readonly layout: File | null;
    readonly target: File | null;
    readonly landmarks: File | null;
    /** Why the files got these roles, for people; null where there was nothing to decide. */
    readonly reason: string | null;
}

const layoutName = /layout|control|cage|coarse|patch/i;

/** Decides which dropped file is what. Of several files of one kind the last counts. */
export function assignRoles(sightings: readonly Sighting[]): Roles {
    const landmarks = sightings.filter((s) => s.kind === "landmarks").at(-1)?.file ?? null;
    const meshes = sightings.filter((s) => s.kind === "mesh").slice(-2);
    const [a, b] = meshes;
    if (!a) return { layout: null, target: null, landmarks, reason: null };
    if (!b) {
        const isLayout = layoutName.test(a.file.name) || a.polygons || a.vertices < 100;
        return {
            layout: isLayout ? a.file : null,
            target: isLayout ? null : a.file,
            landmarks,
            reason: isLayout
                ? `${a.file.name} was taken as the layout, ${whyLayout(a)}.`
                : `${a.file.name} was taken as the target, since it has many vertices, all in triangles.`,
        };
    }
    const [layout, target, why] = decide(a, b);
    return {
        layout: layout.file,
        target: target.file,
        landmarks,
        reason: `${layout.file.name} was taken as the layout and ${target.file.name} as the target, ${why}.`,
    };
}

function whyLayout(mesh: Sighting): string {
    if (layoutName.test(mesh.file.name)) return "going by its name";
    return mesh.polygons ? "since not all of its faces are triangles" : "since it has few vertices";
}

function decide(a: Sighting, b: Sighting): [Sighting, Sighting, string] {
    if (a.polygons !== b.polygons)
        return a.polygons
            ? [a, b, "since only the layout may have faces that are not triangles"]
            : [b, a, "since only the layout may have faces that are not triangles"];
    const named = [a, b].filter((s) => layoutName.test(s.file.name));
    if (named.length === 1)
        return named[0] === a ? [a, b, "going by their names"] : [b, a, "going by their names"];
    return a.vertices <= b.vertices
        ? [a, b, "since it has fewer vertices"]
        : [b, a, "since it has fewer vertices"];
}
