// layout-embedding batch: one layout in all meshes of a folder. What is done is kept in a folder per
// member, so that an interrupted batch goes on where it stopped.
import { createHash } from "node:crypto";
import { readdir, readFile } from "node:fs/promises";
import path from "node:path";
import { batchIn, batchTable } from "../batch.js";
import { javaScriptError } from "../errors.js";
import { jsonBytes } from "../files.js";
import { mapDocument, overlayObj } from "../map_files.js";
import { Session } from "../session.js";
import type { BatchMember, BatchProducts, BatchRow } from "../types.js";
import type { BatchCommand } from "./arguments.js";
import { fileError, readInput } from "./input_files.js";
import { exitCodes, type Outcome } from "./outcome.js";
import { OutputFolder } from "./output_folder.js";

const meshFile = /\.(obj|off|ply|stl|glb)$/i;
/** In the order in which they are looked for. */
const landmarkEndings = [".txt", ".landmarks", ".vts", ".mrk.json", ".json", ".pp"];

export async function runBatch(command: BatchCommand): Promise<Outcome> {
    const interrupt = new AbortController();
    const stop = () => {
        interrupt.abort();
    };
    process.once("SIGINT", stop);
    process.once("SIGTERM", stop);
    const output = await OutputFolder.prepare(command.output);
    const session = await Session.create();
    try {
        const layout = await readInput("the layout", command.layout);
        const members = await membersOf(command.folder);
        const prints = await fingerprints(command, layout.bytes, members);
        const known = await knownRows(command, prints);
        const rows = await batchIn(session, layout, members, {
            solve: command.solve,
            quads: command.quads,
            map: command.map,
            repair: command.repair,
            reference: command.reference,
            signal: interrupt.signal,
            known: (name) => known.get(name) ?? null,
            onMember: async (row, products) => {
                if (products !== null) {
                    await writeMember(command, row, products, prints.get(row.name) ?? "");
                }
                if (!command.quiet && !command.json) {
                    process.stderr.write(`${rowText(row)}\n`);
                }
            },
        });
        const files = await output.write({
            "summary.csv": new TextEncoder().encode(batchTable(rows)),
            "summary.json": jsonBytes({ version: 1, members: rows }),
        });
        const failed = rows.filter((row) => row.error !== null).length;
        const missing = members.length - rows.length;
        return {
            exitCode: interrupt.signal.aborted
                ? exitCodes.interrupted
                : failed > 0
                  ? exitCodes.noneFound
                  : exitCodes.success,
            text: command.quiet
                ? ""
                : `${String(rows.length - failed)} of ${String(members.length)} members done, ` +
                  `${String(failed)} failed, ${String(missing)} not tried\n` +
                  `written: ${files.join(", ")}`,
            document: { members: rows, files },
        };
    } finally {
        await session.dispose();
        await output.leave();
        process.off("SIGINT", stop);
        process.off("SIGTERM", stop);
    }
}

interface FolderMember extends BatchMember {
    mesh: string;
    landmarks: string | null;
}

/** The meshes of a folder by name, each with the landmark file of its name. */
async function membersOf(folder: string): Promise<FolderMember[]> {
    let files: string[];
    try {
        files = (await readdir(folder)).sort();
    } catch (reason) {
        throw fileError("the folder", folder, reason);
    }
    const members = new Map<string, FolderMember>();
    for (const file of files.filter((name) => meshFile.test(name))) {
        const name = file.replace(meshFile, "");
        const ending = landmarkEndings.find((candidate) => files.includes(name + candidate));
        const mesh = path.join(folder, file);
        const landmarks = ending === undefined ? null : path.join(folder, name + ending);
        if (members.has(name)) {
            throw javaScriptError("invalidInput", `${folder} has two meshes called ${name}`);
        }
        members.set(name, {
            name,
            mesh,
            landmarks,
            load: async () => {
                if (landmarks === null) {
                    throw javaScriptError(
                        "fileNotFound",
                        `there is no landmark file of the name ${name} beside ${file}`,
                    );
                }
                return {
                    target: await readInput("the target", mesh),
                    landmarks: await readInput("the landmark file", landmarks),
                };
            },
        });
    }
    if (members.size === 0) {
        throw javaScriptError("fileNotFound", `there is no mesh in ${folder}`);
    }
    return [...members.values()];
}

/** What the results of each member depend on: if it is the same, they are. */
async function fingerprints(
    command: BatchCommand,
    layout: Uint8Array,
    members: readonly FolderMember[],
): Promise<Map<string, string>> {
    const { solve, quads, map, reference, repair } = command;
    const common = createHash("sha256")
        .update(JSON.stringify({ solve, quads, map, repair }))
        .update(layout)
        .digest("hex");
    const read = (file: string | null) =>
        file === null ? "" : readFile(file).catch(() => "" as const);
    const own = new Map<string, string>();
    for (const { name, mesh, landmarks } of members) {
        const hash = createHash("sha256").update(common);
        hash.update(await read(mesh))
            .update("\0")
            .update(await read(landmarks));
        own.set(name, hash.digest("hex"));
    }
    // Maps and numbers of segments depend on the reference, too; the first member unless named.
    const first = own.get(reference ?? members[0]?.name ?? "") ?? "";
    return new Map([...own].map(([name, print]) => [name, `${print}-${first}`]));
}

/** The rows of members that an earlier run has finished. */
async function knownRows(
    command: BatchCommand,
    prints: Map<string, string>,
): Promise<Map<string, BatchRow>> {
    const known = new Map<string, BatchRow>();
    for (const [name, print] of prints) {
        try {
            const text = await readFile(path.join(command.output, name, "member.json"), "utf8");
            const { fingerprint, row } = JSON.parse(text) as {
                fingerprint?: string;
                row?: BatchRow;
            };
            if (fingerprint === print && row?.name === name) {
                known.set(name, row);
            }
        } catch {
            // It is done again.
        }
    }
    return known;
}

async function writeMember(
    command: BatchCommand,
    row: BatchRow,
    { files, quads, map }: BatchProducts,
    fingerprint: string,
): Promise<void> {
    const folder = await OutputFolder.prepare(path.join(command.output, row.name));
    await folder.write({
        ...files,
        "quads.obj": quads.obj,
        ...(map === null
            ? {}
            : {
                  "map.json": jsonBytes(mapDocument(map)),
                  "overlay_reference.obj": overlayObj(map, "reference", null),
                  "overlay.obj": overlayObj(map, "target", null),
              }),
    });
    // Last, so that nothing unfinished counts as done.
    await folder.write({ "member.json": jsonBytes({ fingerprint, row }) });
}

function rowText(row: BatchRow): string {
    if (row.error !== null) {
        return `${row.name}: ${row.error.message}`;
    }
    const energy = row.energy === undefined ? "the reference" : `energy ${row.energy.toFixed(3)}`;
    return (
        `${row.name}: cost ${row.cost?.toPrecision(6) ?? ""}, gap ` +
        `${(100 * (row.gap ?? 1)).toFixed(2)} %, ${String(row.flippedQuads)} of ` +
        `${String(row.quads)} quads flipped, ${energy}`
    );
}
