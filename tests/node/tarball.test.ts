// What npm would publish, installed into an empty folder and used there.
import { mkdirSync, readdirSync, statSync, writeFileSync } from "node:fs";
import path from "node:path";
import { expect, test } from "vitest";
import { inFolder, runProgram } from "./command.js";
import { obj, octahedron, sphere } from "./meshes.js";

const packageFolder = path.resolve(import.meta.dirname, "../../wasm");

/** One file that uses both entries and the exported module, as users would. */
const script = `
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { embed, init } from "layout-embedding";
import { createWorkerClient } from "layout-embedding/worker";
const mesh = (name) => ({ bytes: readFileSync(name), name });
const problem = { layout: mesh("layout.obj"), target: mesh("target.obj") };
const here = await embed(problem);
const worker = await createWorkerClient();
const there = await worker.embed(problem);
worker.terminate();
await init({ wasm: readFileSync(fileURLToPath(import.meta.resolve("layout-embedding/core.wasm"))) });
const again = await embed(problem);
console.log(JSON.stringify([here, there, again].map((r) => [r.status, String(r.exactCost)])));
`;

test("the_packed_package_works_in_an_empty_folder", () =>
    inFolder(async (folder) => {
        const npm = (args: string[], cwd: string) =>
            runProgram("npm", [...args, "--loglevel=error"], { cwd });
        const packed = await npm(["pack", "--pack-destination", folder], packageFolder);
        expect(packed.exitCode, packed.stderr).toBe(0);
        const tarball = readdirSync(folder).find((name) => name.endsWith(".tgz"))!;
        expect(statSync(path.join(folder, tarball)).size).toBeLessThan(1_500_000);

        const user = path.join(folder, "user");
        mkdirSync(user);
        writeFileSync(path.join(user, "package.json"), '{ "private": true, "type": "module" }');
        const install = ["install", "--offline", "--no-audit", "--no-fund", `../${tarball}`];
        const installed = await npm(install, user);
        expect(installed.exitCode, installed.stderr).toBe(0);
        expect(readdirSync(path.join(user, "node_modules/layout-embedding")).sort()).toEqual([
            "LICENSE",
            "README.md",
            "dist",
            "package.json",
        ]);

        writeFileSync(path.join(user, "layout.obj"), obj(octahedron));
        writeFileSync(path.join(user, "target.obj"), obj(sphere(2)));
        writeFileSync(path.join(user, "script.js"), script);
        const used = await runProgram(process.execPath, ["script.js"], { cwd: user });
        expect(used.stderr).toBe("");
        const [here, there, again] = JSON.parse(used.stdout) as [unknown, unknown, unknown];
        expect(here).toEqual(["optimal", expect.any(String)]);
        expect(there).toEqual(here);
        expect(again).toEqual(here);

        const command = path.join(user, "node_modules/.bin/layout-embedding");
        const embedded = await runProgram(
            command,
            ["embed", "layout.obj", "target.obj", "--output", "out"],
            { cwd: user },
        );
        expect(embedded).toMatchObject({ exitCode: 0, stderr: "" });
        const checked = await runProgram(command, ["check", "out", "layout.obj", "target.obj"], {
            cwd: user,
        });
        expect(checked.exitCode).toBe(0);
    }));
