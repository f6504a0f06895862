// One embedding in WebAssembly, measured: the same as bench_embed.cc, through the package.
//   node embed_wasm.mjs LAYOUT TARGET [LANDMARKS]
// Prints one JSON object, with the landmarks that were used.
import { readFileSync } from "node:fs";
import { Session } from "layout-embedding";

const [layoutPath, targetPath, landmarksPath] = process.argv.slice(2);
const file = (path) => ({ bytes: readFileSync(path), name: path });

const start = performance.now();
const session = await Session.create();
await session.loadLayout(file(layoutPath));
await session.loadTarget(file(targetPath));
const { landmarks } = landmarksPath
    ? await session.setLandmarks(file(landmarksPath))
    : await session.landmarksByProximity();
const loaded = performance.now();
const result = await session.solve();
const seconds = (performance.now() - start) / 1000;

const phases = { load: (loaded - start) / 1000 };
const began = result.events.filter(({ kind }) => kind === "phase");
for (const [i, { phase, seconds: at }] of began.slice(0, -1).entries()) {
    phases[phase] = began[i + 1].seconds - at;
}
const { user, system } = process.cpuUsage();
console.log(
    JSON.stringify({
        status: result.status,
        cost: Number.isFinite(result.cost) ? result.cost : null,
        exactCost: result.exactCost?.toString() ?? null,
        lowerBound: result.lowerBound,
        exactLowerBound: result.exactLowerBound.toString(),
        gap: result.gap,
        phases,
        counters: result.counters,
        seconds,
        cpuSeconds: (user + system) / 1e6,
        peakMegabytes: process.resourceUsage().maxRSS / 1024,
        landmarks: Array.from(landmarks),
    }),
);
await session.dispose();
