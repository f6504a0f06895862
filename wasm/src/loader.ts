// Finds, compiles and starts core.wasm, which is built without Emscripten's JavaScript so that the
// same file works in Node, browsers, workers and bundlers. Nothing of a browser or of Node is
// touched before init() is called.
import { javaScriptError, type LayoutError } from "./errors.js";

/** Where core.wasm comes from: an address, its bytes, a response to fetch(), or compiled. */
export type WasmSource =
    string | URL | ArrayBuffer | Uint8Array | Response | WebAssembly.Module | Promise<Response>;

/** Where the module is loaded from. */
export interface InitOptions {
    /** Default: `core.wasm` beside this file. */
    wasm?: WasmSource;
}

/** What the module exports: memory, and functions of numbers (64-bit integers as bigint). */
export interface CoreExports {
    memory: WebAssembly.Memory;
    [name: string]: WebAssembly.ExportValue;
}

let loading: Promise<WebAssembly.Module> | null = null;

/**
 * Loads and compiles the module, once for all sessions; called by whatever needs it, so that only
 * those who want another source, or to load early, have to call it. Without options it waits for
 * the load under way; with a source it loads again. A failed load can be repeated.
 */
export async function init(options: InitOptions = {}): Promise<void> {
    await compiledModule(options);
}

export function compiledModule(options: InitOptions = {}): Promise<WebAssembly.Module> {
    if (loading === null || options.wasm !== undefined) {
        const attempt = compile(options.wasm ?? new URL("./core.wasm", import.meta.url)).catch(
            (reason: unknown) => {
                if (loading === attempt) {
                    loading = null;
                }
                throw loadError(reason);
            },
        );
        loading = attempt;
    }
    return loading;
}

/** A new instance with a memory of its own, ready to be called. */
export async function instantiate(module: WebAssembly.Module): Promise<CoreExports> {
    let memory: WebAssembly.Memory | null = null;
    const imports = systemInterface(() => {
        if (memory === null) {
            throw new Error("the module called its host before it was started");
        }
        return memory.buffer;
    });
    try {
        const instance = await WebAssembly.instantiate(module, imports);
        const exports = instance.exports as CoreExports;
        memory = exports.memory;
        (exports["_initialize"] as () => void)();
        return exports;
    } catch (reason) {
        throw loadError(reason);
    }
}

function loadError(reason: unknown): LayoutError {
    const cause = reason instanceof Error ? reason.message : String(reason);
    return javaScriptError("moduleNotLoaded", `core.wasm could not be loaded (${cause})`);
}

async function compile(source: WasmSource): Promise<WebAssembly.Module> {
    const given = await source;
    if (given instanceof WebAssembly.Module) {
        return given;
    }
    if (given instanceof ArrayBuffer || given instanceof Uint8Array) {
        return WebAssembly.compile(given as BufferSource);
    }
    if (typeof given === "string" || given instanceof URL) {
        const url = new URL(given, import.meta.url);
        return url.protocol === "file:" ? compileFile(url) : compileResponse(await fetch(url));
    }
    return compileResponse(given);
}

async function compileResponse(response: Response): Promise<WebAssembly.Module> {
    if (!response.ok) {
        throw new Error(`${response.url}: ${String(response.status)} ${response.statusText}`);
    }
    // Streaming wants this very type, which not every static server sends.
    const type = response.headers.get("Content-Type") ?? "";
    if (type.startsWith("application/wasm")) {
        return WebAssembly.compileStreaming(response);
    }
    return WebAssembly.compile(await response.arrayBuffer());
}

/** Node's fetch() knows no file addresses. */
async function compileFile(url: URL): Promise<WebAssembly.Module> {
    // Not a literal, so that bundlers for the browser don't look for it.
    const name = "node:fs/promises";
    const { readFile } = (await import(/* @vite-ignore */ name)) as {
        readFile: (file: URL) => Promise<Uint8Array<ArrayBuffer>>;
    };
    return WebAssembly.compile(await readFile(url));
}

// The part of the WebAssembly system interface (WASI preview 1) that Emscripten's C library can
// ask for. There are no files, no arguments and no environment, and nothing is printed.
const success = 0;
const badDescriptor = 8;
const notSupported = 58;

function systemInterface(buffer: () => ArrayBuffer): WebAssembly.Imports {
    const view = () => new DataView(buffer());
    const wasi = {
        clock_time_get(clock: number, _precision: bigint, result: number): number {
            view().setBigUint64(result >>> 0, nanoseconds(clock), true);
            return success;
        },
        clock_res_get(_clock: number, result: number): number {
            view().setBigUint64(result >>> 0, 1000n, true);
            return success;
        },
        environ_sizes_get(count: number, size: number): number {
            view().setUint32(count >>> 0, 0, true);
            view().setUint32(size >>> 0, 0, true);
            return success;
        },
        environ_get: () => success,
        args_sizes_get(count: number, size: number): number {
            view().setUint32(count >>> 0, 0, true);
            view().setUint32(size >>> 0, 0, true);
            return success;
        },
        args_get: () => success,
        /** Takes all bytes and drops them. */
        fd_write(_file: number, pieces: number, count: number, written: number): number {
            let bytes = 0;
            for (let i = 0; i < count; ++i) {
                bytes += view().getUint32((pieces >>> 0) + 8 * i + 4, true);
            }
            view().setUint32(written >>> 0, bytes, true);
            return success;
        },
        fd_read: () => badDescriptor,
        fd_close: () => badDescriptor,
        fd_seek: () => badDescriptor,
        fd_fdstat_get: () => badDescriptor,
        proc_exit(code: number): never {
            throw new WebAssembly.RuntimeError(`the module ended itself with code ${String(code)}`);
        },
    };
    const environment = {
        emscripten_notify_memory_growth: () => undefined,
    };
    return {
        wasi_snapshot_preview1: tolerant(wasi, () => notSupported),
        env: tolerant(environment, () => 0),
    };
}

/** Other versions of Emscripten may import a few functions more, none of which can matter here. */
function tolerant<T extends object>(
    functions: T,
    fallback: () => number,
): WebAssembly.ModuleImports {
    return new Proxy(functions, {
        get: (target, name) => Reflect.get(target, name) ?? fallback,
    }) as unknown as WebAssembly.ModuleImports;
}

/** The time of a WASI clock: 0 is the calendar's, 1 a steady one, 2 and 3 the CPU's. */
function nanoseconds(clock: number): bigint {
    if (clock === 0) {
        return BigInt(Date.now()) * 1_000_000n;
    }
    if (clock >= 2) {
        const node = (globalThis as { process?: { cpuUsage?: () => CpuUsage } }).process;
        const usage = node?.cpuUsage?.();
        if (usage !== undefined) {
            return BigInt(usage.user + usage.system) * 1000n;
        }
    }
    // Browsers tell no CPU time; a job's slices take hardly anything but that.
    return BigInt(Math.round(performance.now() * 1e6));
}

/** Microseconds. */
interface CpuUsage {
    user: number;
    system: number;
}
