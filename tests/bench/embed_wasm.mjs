// One embedding in WebAssembly, measured for bench.mjs: the same as bench_embed.cc, through the
// package.
//
//   node embed_wasm.mjs LAYOUT TARGET LANDMARKS WORK [ALGORITHM]
import { readFileSync } from "node:fs";

const [layoutPath, targetPath, landmarksPath, work, algorithm] = process.argv.slice(2);

process.on("uncaughtException", (error) => {
    console.error(error.message);
    process.exit(2);
});

/**
 * CPU seconds of this thread. Linux alone tells them; elsewhere they are those of the process, with
 * the compiler and the garbage collector in their own threads.
 */
function cpuSeconds() {
    try {
        const [nanoseconds] = readFileSync(`/proc/self/task/${process.pid}/schedstat`, "utf8")
            .trim()
            .split(" ");
        return Number(nanoseconds) / 1e9;
    } catch {
        return processSeconds();
    }
}

function processSeconds() {
    const { user, system } = process.cpuUsage();
    return (user + system) / 1e6;
}

// The package shows the module's memory to nobody, so its memory is caught where it is made. It
// never shrinks: its size at the end is the peak.
const memories = [];
const { instantiate } = WebAssembly;
WebAssembly.instantiate = async (...args) => {
    const result = await instantiate(...args);
    const { memory } = (result.instance ?? result).exports;
    if (memory !== undefined) {
        memories.push(memory);
    }
    return result;
};
const moduleMegabytes = () =>
    memories.reduce((sum, memory) => sum + memory.buffer.byteLength, 0) / 2 ** 20;

const { Session } = await import("layout-embedding");
const file = (path) => ({ bytes: readFileSync(path), name: path });
const began = cpuSeconds();
const session = await Session.create();
const layout = await session.loadLayout(file(layoutPath));
const target = await session.loadTarget(file(targetPath));
const { landmarks } =
    landmarksPath === "proximity"
        ? await session.landmarksByProximity()
        : await session.setLandmarks(file(landmarksPath));
const loaded = cpuSeconds();
const loadedMegabytes = moduleMegabytes();
const result = await session.solve({
    workLimit: Number(work),
    ...(algorithm === undefined ? {} : { algorithm }),
});
const solved = cpuSeconds();

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
            process: processSeconds(),
        },
        memory: {
            load: loadedMegabytes,
            peak: moduleMegabytes(),
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
