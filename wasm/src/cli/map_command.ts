// layout-embedding map: one layout in two targets, and the map between these.
import path from "node:path";
import { javaScriptError } from "../errors.js";
import { mapFiles } from "../map_files.js";
import { Session } from "../session.js";
import type { SurfaceMap } from "../types.js";
import type { MapCommand } from "./arguments.js";
import { readInput } from "./input_files.js";
import { exitCodes, type Outcome } from "./outcome.js";
import { OutputFolder } from "./output_folder.js";

const names = ["a", "b"] as const;

export async function runMap(command: MapCommand): Promise<Outcome> {
    const folders: OutputFolder[] = [];
    const session = await Session.create();
    try {
        const output = await OutputFolder.prepare(command.output);
        folders.push(output);
        const options = { repair: command.repair };
        const layout = await readInput("the layout", command.layout);
        note(command, (await session.loadLayout(layout, options)).notes);
        const costs: Record<string, unknown> = {};
        let texture: Float64Array | null = null;
        const files: string[] = [];
        for (const [side, name] of names.entries()) {
            const target = await readInput(`target ${name}`, command.targets[side] ?? "");
            const { notes, textureCoordinates } = await session.loadTarget(target, {
                ...options,
                textureCoordinates: side === 0,
            });
            note(command, notes);
            const landmarks = command.landmarks[side] ?? null;
            const set =
                landmarks === null
                    ? await session.landmarksByProximity()
                    : await session.setLandmarks(await readInput("the landmark file", landmarks));
            note(command, set.notes);
            const result = await session.solve(command.solve);
            if (result.refined === null) {
                throw javaScriptError(
                    "noEmbedding",
                    `the layout was not embedded in target ${name} (${result.status})`,
                );
            }
            const { cost, lowerBound, gap, status } = result;
            costs[name] = { cost, lowerBound, gap, status };
            const folder = await OutputFolder.prepare(path.join(command.output, name));
            folders.unshift(folder);
            files.push(...(await folder.write({ ...(await session.exportFiles()) })));
            if (side === 0) {
                await session.setReference();
                texture = textureCoordinates;
            }
        }
        const map = await session.mapFromReference(command.map);
        files.push(...(await output.write(mapFiles(map, texture))));
        const { distortion, firstDistortion, overlay } = map;
        const overlayTriangles = overlay.patches.length;
        return {
            exitCode: exitCodes.success,
            text: command.quiet ? "" : `${mapText(map)}\nwritten: ${files.join(", ")}`,
            document: { ...costs, distortion, firstDistortion, overlayTriangles, files },
        };
    } finally {
        await session.dispose();
        for (const folder of folders) {
            await folder.leave();
        }
    }
}

function note(command: MapCommand, notes: string[]): void {
    if (!command.quiet && !command.json) {
        for (const line of notes) {
            process.stderr.write(`note: ${line}\n`);
        }
    }
}

function mapText({ distortion, firstDistortion, overlay }: SurfaceMap): string {
    return (
        `symmetric Dirichlet energy ${distortion.meanEnergy.toFixed(4)} on average ` +
        `(${firstDistortion.meanEnergy.toFixed(4)} before optimisation; 4 is an isometry), ` +
        `angles distorted by ${distortion.meanConformal.toFixed(3)}, ` +
        `areas by ${distortion.meanArea.toFixed(3)}; ` +
        `${String(overlay.patches.length)} triangles in the overlay`
    );
}
