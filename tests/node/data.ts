// The real meshes and instances that are not part of the project.
import { existsSync } from "node:fs";
import path from "node:path";

const root = path.resolve(import.meta.dirname, "../..");

/** The folder that holds data/ and instances/. */
export const shared = process.env["LAYOUT_EMBEDDING_DATA"] ?? path.resolve(root, "../shared");

/** Whether the files are there; otherwise tests that need them are skipped, and say so. */
export const hasShared =
    existsSync(path.join(shared, "data")) && existsSync(path.join(shared, "instances"));
if (!hasShared) {
    console.warn(`skipping tests on real data: nothing in ${shared} (set LAYOUT_EMBEDDING_DATA)`);
}

export interface Instance {
    name: string;
    layout: string;
    target: string;
    /** Null: by proximity. */
    landmarks: string | null;
}

const at = (place: string) => path.join(shared, place);

export const controlMeshes: Instance[] = ["spot", "penguin"].map((name) => ({
    name,
    layout: at(`data/${name}_control_mesh.obj`),
    target: at(`data/${name}.obj`),
    landmarks: null,
}));

export const sphereCubes: Instance[] = [5, 6].flatMap((level) =>
    Array.from({ length: 10 }, (_, i) => ({
        name: `sphere${String(level)}_seed${String(i + 1)}`,
        layout: at("instances/sphere_cube/cube_layout.obj"),
        target: at(`instances/sphere${String(level)}.obj`),
        landmarks: at(`instances/sphere_cube/sphere${String(level)}_seed${String(i + 1)}.txt`),
    })),
);

/** Targets of all kinds: closed, with a boundary, of genus 1 and 2. */
export const realMeshes = ["spot_fourleg", "fish", "scorpion_low_resolution"]
    .concat(["hand_lowres", "demosthenes-low-res", "torus", "skull_low_resolution"])
    .map((name) => ({ name, target: at(`data/${name}.obj`) }));
