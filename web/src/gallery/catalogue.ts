// The project's own shapes, which lie beside the page as files.
import type { MeshFile } from "layout-embedding";

interface IndexMember {
    readonly name: string;
    readonly vertices: number;
    readonly mesh: string;
    readonly landmarks: string;
}

interface IndexClass {
    readonly name: string;
    readonly title: string;
    readonly genus: number;
    readonly boundaryLoops: number;
    readonly landmarkNames: string;
    readonly members: readonly IndexMember[];
}

/** A shape's files. */
export interface OpenedShape {
    readonly target: MeshFile;
    readonly landmarks: Uint32Array;
    /** What the landmarks are called, in their order. */
    readonly names: readonly string[];
}

/** A target with landmarks that correspond to those of the other shapes of its class. */
export interface Shape {
    /** "class/member". */
    readonly id: string;
    readonly title: string;
    /** The class's name, and its title: "Four-legged animals". */
    readonly family: string;
    readonly familyTitle: string;
    /** What is special about the surface, in words; empty for a sphere. */
    readonly topology: string;
    /** Address of a picture of the solved shape. */
    readonly picture: string;
    readonly open: () => Promise<OpenedShape>;
}

const folder = new URL("shapes/", document.baseURI);

async function fetchFile(path: string): Promise<Response> {
    const response = await fetch(new URL(path, folder));
    if (!response.ok)
        throw new Error(
            `The page's own file ${path} could not be fetched (${response.status}); reload the page.`,
        );
    return response;
}

let shapes: Promise<readonly Shape[]> | null = null;

/** All shapes, by class; fetched once. */
export function loadShapes(): Promise<readonly Shape[]> {
    shapes ??= fetchFile("index.json")
        .then((response) => response.json() as Promise<{ classes: readonly IndexClass[] }>)
        .then(({ classes }) => classes.flatMap((one) => one.members.map((m) => shapeOf(one, m))))
        .catch((error: unknown) => {
            shapes = null;
            throw error;
        });
    return shapes;
}

function shapeOf(family: IndexClass, member: IndexMember): Shape {
    const id = `${family.name}/${member.name}`;
    return {
        id,
        title: capitalised(spaced(member.name)),
        family: family.name,
        familyTitle: family.title,
        topology: topologyOf(family),
        picture: new URL(`${id}.webp`, folder).href,
        open: async () => {
            const [mesh, landmarks, names] = await Promise.all([
                fetchFile(member.mesh).then((response) => response.arrayBuffer()),
                fetchFile(member.landmarks).then((response) => response.text()),
                fetchFile(family.landmarkNames).then(
                    (response) => response.json() as Promise<{ landmarks: readonly string[] }>,
                ),
            ]);
            return {
                target: { name: `${member.name}.obj`, bytes: mesh },
                landmarks: Uint32Array.from(landmarks.trim().split(/\s+/), Number),
                names: names.landmarks.map(spaced),
            };
        },
    };
}

function topologyOf({ genus, boundaryLoops }: IndexClass): string {
    const holes = ["", "one handle", "two handles", "three handles"][genus] ?? `genus ${genus}`;
    return [holes, boundaryLoops > 0 ? "open" : ""].filter((part) => part !== "").join(", ");
}

const spaced = (name: string) => name.replaceAll("_", " ");
const capitalised = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);
