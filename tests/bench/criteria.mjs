// What --check demands: one row per criterion. Times are CPU seconds.
//
// `of` picks the instances, `value` what is measured (Infinity where nothing was reached), `limit`
// what it may be, a number or a function of the result. A criterion holds if all its instances do;
// `together` measures them as one case.

// The public reference implementation of the paper: 60 s of CPU time, seeds 1 to 10.
const referenceCosts = {
    sphere5: [20.0949, 21.418, 20.0952, 23.371, 19.804, 21.78, 22.5186, 18.0209, 18.0592, 20.2605],
    sphere6: [17.2814, 19.7266, 21.6922, 23.301, 26.093, 18.7329, 26.3938, 16.4937, 17.6006, 20.0778],
}; // prettier-ignore

const family =
    (...names) =>
    (instance) =>
        names.includes(instance.family);
const named = (name) => (instance) => instance.name === name;

/** Seconds of search until the gap was proved to be at most `gap`. */
const proved =
    (gap) =>
    ({ native }) => {
        const reached = ({ cost, lowerBound }) => cost !== null && cost - lowerBound <= gap * cost;
        if (!native.valid || !reached(native)) {
            return Infinity;
        }
        return native.history.find(reached)?.cpu ?? native.cpu.end;
    };
/** From the start of reading to a checked embedding, without improving the first one. */
const firstValid = ({ wasm }) =>
    wasm.valid ? wasm.cpu.load + wasm.cpu.first + wasm.cpu.total - wasm.cpu.end : Infinity;
/** Short jobs in WebAssembly as the second of an instance: see embed_wasm.mjs. */
export const ratio = ({ native, wasm }) => (wasm.cpu.again ?? wasm.cpu.total) / native.cpu.total;

export const criteria = [
    {
        title: "cubes on sphere5 proved to 1 %",
        needs: ["native"],
        of: family("sphere5"),
        value: proved(0.01),
        limit: 2,
        unit: "s",
    },
    {
        title: "cubes on sphere6 proved to 1 %",
        needs: ["native"],
        of: family("sphere6"),
        value: proved(0.01),
        limit: 10,
        unit: "s",
    },
    {
        title: "cubes: cost relative to the reference",
        needs: ["native"],
        of: family("sphere5", "sphere6"),
        value: ({ native, instance }) =>
            (native.cost ?? Infinity) / referenceCosts[instance.family][instance.seed - 1],
        limit: 1.005,
        unit: "",
    },
    {
        title: "hull and icosahedron, p10 to p30, proved to 1 %",
        needs: ["native"],
        of: (instance) => family("hull", "ico")(instance) && instance.displacement <= 30,
        value: proved(0.01),
        limit: 10,
        unit: "s",
    },
    {
        title: "Spot's 188-vertex layout proved to 1 %",
        needs: ["native"],
        of: named("spot"),
        value: proved(0.01),
        limit: 1,
        unit: "s",
    },
    {
        title: "cubes on sphere5 proved to gap zero",
        needs: ["native"],
        of: family("sphere5"),
        value: proved(0),
        limit: 3,
        unit: "s",
    },
    {
        title: "cubes on sphere6 proved to gap zero",
        needs: ["native"],
        of: family("sphere6"),
        value: proved(0),
        limit: 12,
        unit: "s",
    },
    {
        title: "hull p10 to p30 and icosahedron p20 to p50 proved to gap zero",
        needs: ["native"],
        of: (instance) =>
            (instance.family === "hull" && instance.displacement <= 30) ||
            (instance.family === "ico" && instance.displacement <= 50),
        value: proved(0),
        limit: 3,
        unit: "s",
    },
    {
        title: "hull30 p50 and icosahedron p100 proved to 5 %",
        needs: ["native"],
        of: (instance) => instance.name === "hull30 p50" || instance.displacement === 100,
        value: proved(0.05),
        limit: 60,
        unit: "s",
    },
    {
        // Together: single short jobs differ by a fifth from run to run. The table has them all.
        title: "WASM, compiled, relative to native, all jobs from 0.5 s on together",
        needs: ["native", "wasm"],
        of: ({ native }) => native.cpu.total >= 0.5,
        ofResult: true,
        together: (results) => {
            const sum = (seconds) => results.reduce((all, result) => all + seconds(result), 0);
            const native = ({ native: { cpu } }) => cpu.total;
            return sum((result) => ratio(result) * native(result)) / sum(native);
        },
        limit: 1.25,
        unit: "",
    },
    {
        title: "memory of the search beyond distance fields, up to 50k vertices",
        needs: ["native"],
        of: ({ native }) => native.size.vertices <= 50_000,
        ofResult: true,
        value: ({ native }) =>
            native.memory.search - (4 * native.size.nodes * native.size.landmarks) / 2 ** 20,
        limit: 64,
        unit: "MB",
    },
    {
        title: "straightening of all paths, targets of up to 12k vertices",
        needs: ["native"],
        of: ({ native }) => native.valid && native.size.vertices <= 12_000,
        ofResult: true,
        value: ({ native }) => native.cpu.shape,
        limit: 0.5,
        unit: "s",
    },
    {
        title: "straight paths: length relative to the cost, real meshes and cubes",
        needs: ["native"],
        of: family("real", "sphere5", "sphere6"),
        value: ({ native }) => (native.valid ? native.paths.length / native.cost : Infinity),
        limit: 1,
        unit: "",
    },
    {
        title: "realisation, targets of up to 110k triangles",
        needs: ["native"],
        of: ({ native }) => native.valid && native.size.triangles <= 110_000,
        ofResult: true,
        value: ({ native }) => native.cpu.shape + native.cpu.cut,
        limit: 1,
        unit: "s",
    },
    {
        title: "a million triangles: first valid embedding in WASM, with reading",
        needs: ["wasm"],
        of: named("mesh 1003520"),
        value: firstValid,
        limit: 15,
        unit: "s",
    },
    {
        title: "a million triangles: memory in WASM",
        needs: ["wasm"],
        of: named("mesh 1003520"),
        value: ({ wasm }) => wasm.memory.peak,
        limit: 1200,
        unit: "MB",
    },
];

/**
 * Judges results: per criterion { title, limit, unit, passed, cases }, a case being
 * { name, value, passed }. Without cases nothing it is about was run.
 */
export function judge(results) {
    return criteria.map(({ title, needs, of, ofResult, value, together, limit, unit }) => {
        const chosen = results
            .filter((result) => needs.every((where) => result[where] && !result[where].error))
            .filter((result) => of(ofResult ? result : result.instance));
        const measured =
            together === undefined
                ? chosen.map((result) => ({ name: result.name, value: value(result) }))
                : chosen.length === 0
                  ? []
                  : [{ name: `${chosen.length} jobs`, value: together(chosen) }];
        const cases = measured.map((one) => ({ ...one, passed: one.value <= limit }));
        return { title, limit, unit, cases, passed: cases.every(({ passed }) => passed) };
    });
}

/** The same for the times of cancel.mjs, which are no instances. */
export function judgeCancel(times) {
    const limit = 100;
    const cases = times.map(({ name, value }) => ({ name, value, passed: value <= limit }));
    const passed = cases.every((one) => one.passed);
    return { title: "an aborted call is settled", limit, unit: "ms", cases, passed };
}
