// npm run experiments -- [--quick] [--only NAME]... [--output DIR] [--render]: the paper's experiments
// and ours, as one HTML page that needs nothing else, with all numbers as JSON beside it.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { availableParallelism, cpus } from "node:os";
import path from "node:path";
import { parseArgs } from "node:util";
import { buildPackage, buildPreset, installPackages } from "../../.dev/build.mjs";
import { StepError, main, root, say } from "../../.dev/run.mjs";
import { ensureSystemPackages } from "../../.dev/system.mjs";
import { experiments } from "./list.mjs";
import { Pool } from "./pool.mjs";
import { writeReport } from "./report/page.mjs";

await main(async () => {
    const options = readOptions();
    const folder = path.resolve(process.env.INIT_CWD ?? process.cwd(), options.output);
    const results = path.join(folder, "results.json");
    if (options.render) {
        writeReport(folder, JSON.parse(readFileSync(results, "utf8")));
        return;
    }
    const chosen = experiments.filter(
        ({ name }) => options.only.length === 0 || options.only.includes(name),
    );
    await build(chosen, options.quick);

    mkdirSync(path.join(folder, "pictures"), { recursive: true });
    const began = performance.now();
    const pool = new Pool(2, folder);
    const run = {
        date: new Date().toISOString(),
        quick: options.quick,
        machine: machine(),
        experiments: {},
    };
    for (const { name, experiment } of chosen) {
        const start = performance.now();
        const { cpuSeconds } = pool;
        const data = await experiment.run({ pool, quick: options.quick, done: run.experiments });
        run.experiments[name] = { data, cpuSeconds: pool.cpuSeconds - cpuSeconds };
        const seconds = (performance.now() - start) / 1000;
        say(
            `${name}: ${seconds.toFixed(0)} s, ${run.experiments[name].cpuSeconds.toFixed(0)} CPU s`,
        );
    }
    run.seconds = (performance.now() - began) / 1000;
    run.cpuSeconds = pool.cpuSeconds;
    run.embeddings = pool.embeddings;
    writeFileSync(results, `${JSON.stringify(run, null, 1)}\n`);
    say(`written to ${path.relative(process.cwd(), writeReport(folder, run))}`);
});

/** The package, and the native programs that the experiments run. */
async function build(chosen, quick) {
    const targets = new Set(chosen.flatMap(({ experiment }) => experiment.tools?.(quick) ?? []));
    await ensureSystemPackages("wasm", ...(targets.size > 0 ? ["native"] : []));
    await installPackages();
    await buildPackage();
    if (targets.size > 0) {
        await buildPreset("release", { targets: [...targets] });
    }
}

function readOptions() {
    const flag = { type: "boolean", default: false };
    let values;
    try {
        ({ values } = parseArgs({
            options: {
                quick: flag,
                render: flag,
                only: { type: "string", multiple: true, default: [] },
                output: { type: "string", default: path.join(root, "build/experiments") },
            },
        }));
    } catch (error) {
        throw new StepError(error.message);
    }
    const names = experiments.map(({ name }) => name);
    const unknown = values.only.find((name) => !names.includes(name));
    if (unknown !== undefined) {
        throw new StepError(`there is no experiment ${unknown}; --only takes ${names.join(", ")}`);
    }
    return values;
}

function machine() {
    return {
        processor: cpus()[0]?.model.trim() ?? "unknown",
        cores: availableParallelism(),
        node: process.version,
        platform: `${process.platform} ${process.arch}`,
    };
}
