// What npm would publish, and a folder of a user who has installed it.
import { mkdirSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { expect } from "vitest";
import { runProgram } from "./command.js";

const packageFolder = path.resolve(import.meta.dirname, "../../wasm");

async function npm(args: string[], cwd: string): Promise<void> {
    const { exitCode, stderr } = await runProgram("npm", [...args, "--loglevel=error"], { cwd });
    expect(exitCode, stderr).toBe(0);
}

/** Packs the package into `folder`; returns the tarball. */
export async function packed(folder: string): Promise<string> {
    await npm(["pack", "--pack-destination", folder], packageFolder);
    const [tarball, ...others] = readdirSync(folder).filter((name) => name.endsWith(".tgz"));
    expect(others).toEqual([]);
    return path.join(folder, tarball!);
}

/** Installs the tarball into an empty folder inside `folder`, which is returned. */
export async function installed(tarball: string, folder: string): Promise<string> {
    const user = path.join(folder, "user");
    mkdirSync(user);
    writeFileSync(path.join(user, "package.json"), '{ "private": true, "type": "module" }');
    await npm(["install", "--offline", "--no-audit", "--no-fund", tarball], user);
    return user;
}

/**
 * The program of another version of Node, from the registry's packages of programs; null where that
 * is out of reach.
 */
export async function otherNode(version: string, folder: string): Promise<string | null> {
    if (process.versions.node.startsWith(`${version}.`)) return process.execPath;
    const name = `node-${process.platform}-${process.arch}`;
    const cwd = path.join(folder, `node${version}`);
    mkdirSync(cwd);
    writeFileSync(path.join(cwd, "package.json"), '{ "private": true }');
    const options = ["--prefer-offline", "--fetch-retries=0", "--no-audit", "--no-fund"];
    const { exitCode } = await runProgram("npm", ["install", ...options, `${name}@${version}`], {
        cwd,
    });
    return exitCode === 0 ? path.join(cwd, "node_modules", name, "bin/node") : null;
}

/**
 * The first example in the language `js`, `ts` or `html` that holds `text`, in the package's README
 * or, for `of` "project", in the project's.
 */
export function example(language: string, text: string, of?: "project"): string {
    const readme = path.join(packageFolder, of === "project" ? ".." : ".", "README.md");
    const blocks = readFileSync(readme, "utf8").matchAll(/^```(\w+)\n([\s\S]*?)^```$/gm);
    for (const [, name, code] of blocks) {
        if (name === language && code?.includes(text) === true) return code;
    }
    throw new Error(`${readme} has no example in ${language} with ${text}`);
}
