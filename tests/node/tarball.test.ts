// What npm would publish: checked as publint and are-the-types-wrong see it, installed into an empty
// folder and used there.
import { checkPackage, createPackageFromTarballData } from "@arethetypeswrong/core";
import {
    cpSync,
    mkdtempSync,
    readdirSync,
    readFileSync,
    rmSync,
    statSync,
    writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { publint } from "publint";
import { formatMessage } from "publint/utils";
import { afterAll, beforeAll, expect, test } from "vitest";
import { runProgram } from "./command.js";
import { obj, octahedron, sphere } from "./meshes.js";
import { example, installed, otherNode, packed } from "./packing.js";

const folder = mkdtempSync(path.join(tmpdir(), "layout-embedding-"));
let tarball: string;
let user: string;
beforeAll(async () => {
    tarball = await packed(folder);
    user = await installed(tarball, folder);
    writeFileSync(path.join(user, "layout.obj"), obj(octahedron));
    writeFileSync(path.join(user, "target.obj"), obj(sphere(2)));
});
afterAll(() => {
    rmSync(folder, { recursive: true, force: true });
});

/** Runs a module in a folder of the user; what it prints. */
async function runScript(
    script: string,
    { cwd = user, stderr = /^$/, node = process.execPath } = {},
): Promise<string> {
    writeFileSync(path.join(cwd, "script.js"), script);
    const finished = await runProgram(node, ["script.js"], { cwd });
    expect(finished.stderr).toMatch(stderr);
    expect(finished.exitCode).toBe(0);
    return finished.stdout;
}

test("the_tarball_is_small_and_holds_nothing_else", () => {
    expect(statSync(tarball).size).toBeLessThan(1_500_000);
    expect(readdirSync(path.join(user, "node_modules/layout-embedding")).sort()).toEqual([
        "ERRORS.md",
        "LICENSE",
        "README.md",
        "dist",
        "package.json",
    ]);
    const manifest = JSON.parse(
        readFileSync(path.join(user, "node_modules/layout-embedding/package.json"), "utf8"),
    ) as { scripts?: Record<string, string>; dependencies?: object };
    expect(manifest.dependencies).toBeUndefined();
    expect(
        Object.keys(manifest.scripts ?? {}).filter((name) => /install|prepare/.test(name)),
    ).toEqual([]);
});

test("publint_finds_nothing", async () => {
    const { buffer } = Uint8Array.from(readFileSync(tarball));
    const { messages, pkg } = await publint({ pack: { tarball: buffer }, strict: true });
    expect(messages.map((message) => formatMessage(message, pkg))).toEqual([]);
});

test("are_the_types_wrong_finds_nothing_in_any_entry", async () => {
    const data = createPackageFromTarballData(Uint8Array.from(readFileSync(tarball)));
    // What is no module has no types: its address is what is resolved.
    const analysis = await checkPackage(data, { excludeEntrypoints: ["./core.wasm"] });
    if (!analysis.types) throw new Error("the package has no types");
    expect(Object.keys(analysis.entrypoints).sort()).toEqual([
        ".",
        "./base64",
        "./package.json",
        "./worker",
    ]);
    // The package has ES modules only, and so asks for what resolves these.
    const problems = analysis.problems.filter(
        (problem) =>
            !("resolutionKind" in problem) ||
            !["node10", "node16-cjs"].includes(problem.resolutionKind),
    );
    expect(problems).toEqual([]);
});

const useEverything = `
        import { readFileSync } from "node:fs";
        import { fileURLToPath } from "node:url";
        import { embed, init } from "layout-embedding";
        import { coreBytes } from "layout-embedding/base64";
        import { createWorkerClient } from "layout-embedding/worker";
        const mesh = (name) => ({ bytes: readFileSync(name), name });
        const problem = { layout: mesh("layout.obj"), target: mesh("target.obj") };
        const results = [await embed(problem)];
        const worker = await createWorkerClient({ wasm: await coreBytes() });
        results.push(await worker.embed(problem));
        worker.terminate();
        const file = fileURLToPath(import.meta.resolve("layout-embedding/core.wasm"));
        for (const wasm of [readFileSync(file), await coreBytes()]) {
            await init({ wasm });
            results.push(await embed(problem));
        }
        console.log(JSON.stringify(results.map((r) => [r.status, String(r.exactCost)])));
    `;
function expectTheSame(results: string): void {
    const [first, ...others] = JSON.parse(results) as unknown[];
    expect(first).toEqual(["optimal", expect.any(String)]);
    expect(others).toEqual([first, first, first]);
}

test("the_api_the_worker_and_both_forms_of_the_module_work_in_node", async () => {
    expectTheSame(await runScript(useEverything));
});

test.for(["22", "24"])("they_work_in_node_%s", async (version, { skip }) => {
    const node = await otherNode(version, folder);
    if (node === null)
        return skip(`Node ${version} is neither this one nor to be had from the registry`);
    expectTheSame(await runScript(useEverything, { node }));
    const cli = path.join(user, "node_modules/layout-embedding/dist/cli.js");
    const args = [cli, "embed", "layout.obj", "target.obj", "--output", `out${version}`];
    expect(await runProgram(node, args, { cwd: user })).toMatchObject({ exitCode: 0, stderr: "" });
});

test("the_examples_of_both_readmes_run", async () => {
    expect(await runScript(example("js", "node:fs"))).toMatch(/^optimal \d+\.\d+ Uint32Array/);
    const tetrahedron = {
        positions: [1, 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1],
        faces: [
            [0, 2, 1],
            [0, 1, 3],
            [0, 3, 2],
            [1, 2, 3],
        ],
    };
    const other = path.join(folder, "other");
    cpSync(user, other, { recursive: true });
    writeFileSync(path.join(other, "layout.obj"), obj(tetrahedron));
    writeFileSync(path.join(other, "target.obj"), obj(sphere(5)));
    // It has no types in it: the code is JavaScript, too.
    const code = example("ts", "onProgress", "project");
    expect(await runScript(code, { cwd: other, stderr: /^search \d/m })).toMatch(
        /^optimal \d+\.\d+ \d+\.\d+ Uint32Array/,
    );
});

test("no_global_of_a_browser_or_of_node_is_touched_when_an_entry_is_loaded", async () => {
    // The language's own globals are those of an empty realm. Node's loader touches some of its own:
    // who does is the frame below the getter's.
    const touched = await runScript(`
        import { createContext, runInContext } from "node:vm";
        const language = runInContext("Object.getOwnPropertyNames(globalThis)", createContext());
        const touched = [];
        for (const name of Object.getOwnPropertyNames(globalThis)) {
            if (language.includes(name)) continue;
            const { value, get } = Object.getOwnPropertyDescriptor(globalThis, name);
            Object.defineProperty(globalThis, name, {
                get() {
                    const caller = String(new Error().stack).split("\\n")[2];
                    if (/layout-embedding|script\\.js/.test(caller)) touched.push(name);
                    return get ? get.call(globalThis) : value;
                },
            });
        }
        for (const entry of ["", "/worker", "/base64"]) await import("layout-embedding" + entry);
        const found = touched.splice(0);
        globalThis.process;
        console.log(JSON.stringify({ found, seen: touched.includes("process") }));
    `);
    expect(JSON.parse(touched)).toEqual({ found: [], seen: true });
});

test("the_command_is_installed_and_works", async () => {
    const command = path.join(user, "node_modules/.bin/layout-embedding");
    const run = (...args: string[]) => runProgram(command, args, { cwd: user });
    const embedded = await run("embed", "layout.obj", "target.obj", "--output", "out");
    expect(embedded).toMatchObject({ exitCode: 0, stderr: "" });
    expect((await run("check", "out", "layout.obj", "target.obj")).exitCode).toBe(0);
});
