// CPU time and WebAssembly memory of this process. To be loaded before the package.
import { readFileSync } from "node:fs";

/**
 * CPU seconds of this thread. Linux alone tells them; elsewhere they are those of the process, with
 * the compiler and the garbage collector in their own threads.
 */
export function threadSeconds() {
    try {
        const [nanoseconds] = readFileSync(`/proc/self/task/${process.pid}/schedstat`, "utf8")
            .trim()
            .split(" ");
        return Number(nanoseconds) / 1e9;
    } catch {
        return processSeconds();
    }
}

/** How often a job is run of which the first took so many seconds; the quickest counts. */
export const runsOf = (seconds) => (seconds < 4 ? 3 : seconds < 8 ? 2 : 1);

export function processSeconds() {
    const { user, system } = process.cpuUsage();
    return (user + system) / 1e6;
}

/** CPU seconds of programs that this process has run to their end; 0 where Linux doesn't tell them. */
export function childSeconds() {
    try {
        const [user, system] = readFileSync("/proc/self/stat", "utf8")
            .split(") ")
            .at(-1)
            .split(" ")
            .slice(13, 15);
        return (Number(user) + Number(system)) / 100;
    } catch {
        return 0;
    }
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

/** The most memory that WebAssembly has taken so far. */
export function moduleMegabytes() {
    return memories.reduce((sum, memory) => sum + memory.buffer.byteLength, 0) / 2 ** 20;
}
