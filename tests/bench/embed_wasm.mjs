// One embedding in WebAssembly, measured for bench.mjs: the same as bench_embed.cc, through the
// package.
//
//   node embed_wasm.mjs LAYOUT TARGET LANDMARKS WORK [ALGORITHM [GAP]]
import { readFileSync } from "node:fs";
import { moduleMegabytes, processSeconds, runsOf, threadSeconds } from "./process.mjs";
// The memory that the package takes is watched by process.mjs.
import { Session } from "layout-embedding";

const [layoutPath, targetPath, landmarksPath, work, algorithm, gap] = process.argv.slice(2);

process.on("uncaughtException", (error) => {
    console.error(error.message);
    process.exit(2);
});

const file = (path) => ({ bytes: readFileSync(path), name: path });
const began = threadSeconds();
const session = await Session.create();
const layout = await session.loadLayout(file(layoutPath));
const target = await session.loadTarget(file(targetPath));
const { landmarks } =
    landmarksPath === "proximity"
        ? await session.landmarksByProximity()
        : await session.setLandmarks(file(landmarksPath));
const loaded = threadSeconds();
const loadedMegabytes = moduleMegabytes();
const options = {
    workLimit: Number(work),
    ...(algorithm === undefined ? {} : { algorithm }),
    ...(gap === undefined ? {} : { gap: Number(gap) }),
};
const result = await session.solve(options);
const solved = threadSeconds();
const peakMegabytes = moduleMegabytes();

// Of a short first job, much of the time goes by before the engine has compiled what is used most.
let again = null;
for (let run = 1; run < runsOf(solved - loaded); ++run) {
    const start = threadSeconds();
    await session.solve(options);
    again = Math.min(again ?? Infinity, threadSeconds() - start);
}

// Events have seconds by the clock, of which CPU seconds are a share, taken to be the same all the
// time.
const last = result.events.at(-1).seconds;
const share = last > 0 ? Math.min(1, (solved - loaded) / last) : 1;
const cpuAt = (event) => (event === undefined ? null : event.seconds * share);
const finite = (number) => (Number.isFinite(number) ? number : null);
const incumbents = result.events.filter(({ kind }) => kind === "incumbent");
const phaseEnd = result.events.find(
    ({ kind, phase }) => kind === "phase" && ["realise", "check", "done"].includes(phase),
);

console.log(
    JSON.stringify({
        algorithm: session.embeddingDocument().algorithm,
        status: result.status,
        valid: result.refined !== null,
        cost: finite(result.cost),
        lowerBound: result.lowerBound,
        gap: result.gap,
        ...(result.exactCost === null ? {} : { exactCost: result.exactCost.toString() }),
        exactLowerBound: result.exactLowerBound.toString(),
        size: {
            vertices: target.vertexCount,
            triangles: target.faceCount,
            nodes: target.vertexCount + target.edgeCount + target.faceCount,
            landmarks: landmarks.length,
            layoutEdges: layout.edgeCount,
        },
        counters: result.counters,
        cpu: {
            load: loaded - began,
            first: cpuAt(incumbents.at(0)),
            best: cpuAt(incumbents.at(-1)),
            end: cpuAt(phaseEnd),
            total: solved - loaded,
            again,
            process: processSeconds(),
        },
        memory: {
            load: loadedMegabytes,
            peak: peakMegabytes,
            process: process.resourceUsage().maxRSS / 1024,
        },
        history: result.events
            .filter(({ kind }) => kind === "incumbent" || kind === "bound")
            .map((event) => ({
                cpu: cpuAt(event),
                work: event.work,
                cost: finite(event.cost),
                lowerBound: event.lowerBound,
            })),
    }),
);
await session.dispose();
