// What every script here needs: where the project is, running commands, and stamps that tell
// whether a step has to be done again. Node's own modules only, since nothing is installed yet when
// these scripts start.
import { AsyncLocalStorage } from "node:async_hooks";
import { spawn, spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import path from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";

export const root = fileURLToPath(new URL("..", import.meta.url)).replace(/\/$/, "");

/** A failure whose message is all the user has to see: no stack trace. */
export class StepError extends Error {}

let quiet = false;

/** The label of the lane that the current code runs in, see inLane(). */
const laneLabel = new AsyncLocalStorage();

/** Runs `action` beside others: every line that it prints begins with the label. */
export function inLane(label, action) {
    return laneLabel.run(label, action);
}

/** Keeps everything off the terminal but errors, which go to stderr; for `npm run cli`. */
export function beQuiet() {
    quiet = true;
}

export function say(line) {
    if (!quiet) {
        const label = laneLabel.getStore();
        console.log(label === undefined ? line : line.replace(/^/gm, `${label} │ `));
    }
}

/**
 * Runs a command in the project's root and waits for it. Its output goes to the terminal, in a lane
 * line by line with the label; when quiet, it is kept back and shown only if the command fails.
 *
 * Resolves to the exit code; throws a StepError for any code but 0 unless `allowFailure` is set.
 */
export function run(command, args, { env = {}, allowFailure = false, cwd = root } = {}) {
    return new Promise((resolve, reject) => {
        const inherit = !quiet && laneLabel.getStore() === undefined;
        const child = spawn(command, args, {
            cwd,
            env: { ...process.env, ...env },
            stdio: inherit ? ["ignore", "inherit", "inherit"] : ["ignore", "pipe", "pipe"],
        });
        const output = [];
        for (const stream of inherit ? [] : [child.stdout, child.stderr]) {
            if (quiet) {
                stream.on("data", (chunk) => output.push(chunk));
            } else {
                createInterface({ input: stream }).on("line", say);
            }
        }
        child.on("error", (error) =>
            reject(new StepError(`${command} could not be started: ${error.message}`)),
        );
        child.on("close", (code, signal) => {
            if (code === 0 || allowFailure) {
                resolve(code ?? 1);
                return;
            }
            process.stderr.write(Buffer.concat(output));
            const how = signal ? `was stopped by ${signal}` : `ended with code ${code}`;
            reject(new StepError(`${path.basename(command)} ${args.join(" ")} ${how}`));
        });
    });
}

/** The output of a command, or null if it is missing or fails. */
export function output(command, args) {
    const result = spawnSync(command, args, { cwd: root, encoding: "utf8" });
    return result.status === 0 ? result.stdout.trim() : null;
}

/** Runs npm itself, also where it is not on the PATH. */
export function runNpm(args, options) {
    const npm = process.env.npm_execpath;
    return npm?.endsWith(".js")
        ? run(process.execPath, [npm, ...args], options)
        : run("npm", args, options);
}

/** What builds write between the sources; wasm/LICENSE is a copy of the project's. */
const generated = new Set([
    "node_modules",
    "dist",
    "build",
    ".vite",
    ".git",
    "bench-results",
    "LICENSE",
]);

/** Files below `place` (a file or a folder, relative to the root) without generated ones, sorted. */
export function filesBelow(place) {
    const full = path.join(root, place);
    if (!existsSync(full)) {
        return [];
    }
    if (place !== "" && !readableFolder(full)) {
        return [place];
    }
    return readdirSync(full, { withFileTypes: true })
        .filter((entry) => !generated.has(entry.name))
        .sort((a, b) => (a.name < b.name ? -1 : 1))
        .flatMap((entry) => {
            const inside = path.join(place, entry.name);
            return entry.isDirectory() ? filesBelow(inside) : entry.isFile() ? [inside] : [];
        });
}

function readableFolder(full) {
    try {
        readdirSync(full);
        return true;
    } catch {
        return false;
    }
}

/** A hash of the names and contents of all files below the given places, and of `extra`. */
export function hashOf(places, extra = "") {
    const hash = createHash("sha256").update(extra);
    for (const place of places) {
        for (const file of filesBelow(place)) {
            hash.update(`\0${file}\0`).update(readFileSync(path.join(root, file)));
        }
    }
    return hash.digest("hex");
}

/**
 * Does `action` unless it was done before with the same `hash` and all of `results` (relative to
 * the root) are still there. A failed action leaves no stamp, so it is tried again.
 */
export async function once(stampFile, hash, results, action) {
    const stamp = path.join(root, stampFile);
    const done =
        existsSync(stamp) &&
        readFileSync(stamp, "utf8") === hash &&
        results.every((result) => existsSync(path.join(root, result)));
    if (!done) {
        await action();
        mkdirSync(path.dirname(stamp), { recursive: true });
        writeFileSync(stamp, hash);
    }
}

/** Runs a script's main function; a StepError becomes one line on stderr and exit code 1. */
export async function main(action) {
    try {
        process.exitCode = (await action()) ?? 0;
    } catch (error) {
        console.error(error instanceof StepError ? `error: ${error.message}` : error);
        process.exitCode = 1;
    }
}
