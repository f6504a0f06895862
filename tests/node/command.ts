// Runs the built command line.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";

const program = path.resolve(import.meta.dirname, "../../wasm/dist/cli.js");

export interface Finished {
    exitCode: number | null;
    stdout: string;
    stderr: string;
}

export interface RunOptions {
    cwd?: string;
    /** Called with the process once it runs. */
    onStart?: (kill: (signal: NodeJS.Signals) => void) => void;
}

export function run(args: string[], options: RunOptions = {}): Promise<Finished> {
    return runProgram(process.execPath, [program, ...args], options);
}

export function runProgram(
    command: string,
    args: string[],
    { cwd, onStart }: RunOptions = {},
): Promise<Finished> {
    return new Promise((resolve, reject) => {
        const child = spawn(command, args, { cwd, stdio: ["ignore", "pipe", "pipe"] });
        let stdout = "";
        let stderr = "";
        child.stdout.setEncoding("utf8").on("data", (text: string) => (stdout += text));
        child.stderr.setEncoding("utf8").on("data", (text: string) => (stderr += text));
        child.on("error", reject);
        child.on("close", (exitCode) => {
            resolve({ exitCode, stdout, stderr });
        });
        onStart?.((signal) => child.kill(signal));
    });
}

/** A folder of its own for a test, gone after `body`. */
export async function inFolder<T>(body: (folder: string) => Promise<T>): Promise<T> {
    const folder = mkdtempSync(path.join(tmpdir(), "layout-embedding-"));
    try {
        return await body(folder);
    } finally {
        rmSync(folder, { recursive: true, force: true });
    }
}
