// The native programs that show what the package does not: parts of searches switched off, all orders
// of insertion, geodesics.
import { spawnSync } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import path from "node:path";
import { root } from "../../.dev/run.mjs";
import { writeLandmarks, writeObj } from "../bench/generate.mjs";

/** What one of the programs in this folder prints as JSON. `files`: see problemFiles(). */
export function runTool(name, { layout, target, landmarks }, args = []) {
    const program = path.join(root, "build/release/tests/experiments", name);
    const words = [layout, target, landmarks, ...args].map(String);
    const { status, stdout, stderr, error } = spawnSync(program, words, {
        encoding: "utf8",
        maxBuffer: 2 ** 30,
    });
    if (status !== 0) {
        throw new Error(`${name} ${words.join(" ")}: ${error?.message ?? stderr}`);
    }
    return JSON.parse(stdout);
}

/**
 * Writes a problem to files, whose paths it returns. Layout and target are { positions, faces } or
 * { bytes }, landmarks a list or { bytes }.
 */
export function problemFiles(name, { layout, target, landmarks }) {
    const folder = path.join(root, "build/experiments-problems", name.replace(/[^\w.-]+/g, "_"));
    mkdirSync(folder, { recursive: true });
    const files = {
        layout: path.join(folder, "layout.obj"),
        target: path.join(folder, "target.obj"),
        landmarks: path.join(folder, "landmarks.txt"),
    };
    for (const [role, mesh] of Object.entries({ layout, target })) {
        if (mesh.bytes) {
            writeFileSync(files[role], mesh.bytes);
        } else {
            writeObj(files[role], mesh);
        }
    }
    if (landmarks.bytes) {
        writeFileSync(files.landmarks, landmarks.bytes);
    } else {
        writeLandmarks(files.landmarks, landmarks);
    }
    return files;
}
