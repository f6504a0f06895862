// One instance of the WebAssembly module: calls, memory and errors. The functions are declared in
// boundary/*.cc. No view on the module's memory outlives a call, since memory that grows leaves old
// views empty.
import { javaScriptError, LayoutError, type ErrorInfo } from "./errors.js";
import { compiledModule, instantiate, type CoreExports, type InitOptions } from "./loader.js";

type Argument = number | bigint;

/** An object inside the module. */
export type Handle = number;

export class Core {
    /** Set once a trap has left the instance in an unknown state. */
    private crashed = false;

    private constructor(private readonly exports: CoreExports) {}

    /** A new instance. */
    static async create(options: InitOptions = {}): Promise<Core> {
        return new Core(await instantiate(await compiledModule(options)));
    }

    /** Calls a function that returns a handle, or 1 for success, and throws its error otherwise. */
    call(name: string, ...args: Argument[]): number {
        const result = this.raw(name, args) >>> 0;
        if (result === 0) {
            throw this.lastError();
        }
        return result;
    }

    /** Calls a function that returns a number from 0 on, and throws its error where it is -1. */
    count(name: string, ...args: Argument[]): number {
        const result = this.raw(name, args);
        if (result === -1) {
            throw this.lastError();
        }
        return result >>> 0;
    }

    /** Calls a function that returns 0 where there is nothing. */
    test(name: string, ...args: Argument[]): boolean {
        return this.raw(name, args) !== 0;
    }

    /** Calls a function that returns a number, whatever it is. */
    number(name: string, ...args: Argument[]): number {
        return this.raw(name, args);
    }

    /** Frees an object; safe in any state. */
    destroy(handle: Handle | null): void {
        if (handle !== null && !this.crashed) {
            this.raw("boundary_destroy", [handle]);
        }
    }

    /**
     * Copies arrays into the module for the time of one call: `body` gets a function that copies
     * one and returns where it lies.
     */
    withCopies<T>(body: (copy: (array: ArrayBufferView) => number) => T): T {
        const pointers: number[] = [];
        try {
            return body((array) => {
                const pointer = this.raw("boundary_allocate", [array.byteLength]) >>> 0;
                if (pointer === 0) {
                    throw new LayoutError(
                        "memoryLimit",
                        `there is no memory left for an input of ${String(array.byteLength)} ` +
                            "bytes; raise the limit or simplify the target.",
                        { bytes: array.byteLength },
                    );
                }
                pointers.push(pointer);
                new Uint8Array(this.exports.memory.buffer, pointer, array.byteLength).set(
                    new Uint8Array(array.buffer, array.byteOffset, array.byteLength),
                );
                return pointer;
            });
        } finally {
            if (!this.crashed) {
                for (const pointer of pointers) {
                    this.raw("boundary_release", [pointer]);
                }
            }
        }
    }

    /** A copy of the array that the last call shows, `size` doubles to an element. */
    viewedDoubles(size = 1): Float64Array<ArrayBuffer> {
        const { data, count } = this.view();
        return new Float64Array(this.exports.memory.buffer, data, count * size).slice();
    }

    viewedIds(size = 1): Uint32Array<ArrayBuffer> {
        const { data, count } = this.view();
        return new Uint32Array(this.exports.memory.buffer, data, count * size).slice();
    }

    viewedLongs(): BigUint64Array<ArrayBuffer> {
        const { data, count } = this.view();
        return new BigUint64Array(this.exports.memory.buffer, data, count).slice();
    }

    viewedBytes(): Uint8Array<ArrayBuffer> {
        const { data, count } = this.view();
        return new Uint8Array(this.exports.memory.buffer, data, count).slice();
    }

    viewedText(): string {
        return new TextDecoder().decode(this.viewedBytes());
    }

    /** The last error that a function left behind. */
    lastError(): LayoutError {
        this.raw("boundary_error_code", []);
        const code = this.viewedText();
        this.raw("boundary_error_message", []);
        const message = this.viewedText();
        const details: Record<string, number> = {};
        const count = this.raw("boundary_error_detail_count", []);
        for (let i = 0; i < count; ++i) {
            const value = this.raw("boundary_error_detail", [i]);
            details[this.viewedText()] = value;
        }
        return new LayoutError(code, message, details);
    }

    /** The core's error table, but for its first row, "no error". */
    errorTable(): ErrorInfo[] {
        const table: ErrorInfo[] = [];
        const column = (name: string, row: number) => {
            return this.test(`boundary_error_info_${name}`, row) ? this.viewedText() : null;
        };
        for (let row = 1; ; ++row) {
            const code = column("name", row);
            const meaning = column("meaning", row);
            const advice = column("advice", row);
            if (code === null || meaning === null || advice === null) {
                return table;
            }
            table.push({ code, meaning, advice });
        }
    }

    /** The version of the library. */
    version(): string {
        this.raw("boundary_version", []);
        return this.viewedText();
    }

    private raw(name: string, args: Argument[]): number {
        if (this.crashed) {
            throw javaScriptError("crashed", "the solver ran into a trap before");
        }
        const target = this.exports[name] as unknown as (...args: Argument[]) => number;
        try {
            return target(...args);
        } catch (reason) {
            // No exception leaves the boundary, so this is a trap: memory out of bounds, a stack
            // overflow, an abort.
            this.crashed = true;
            const cause = reason instanceof Error ? reason.message : String(reason);
            throw javaScriptError("crashed", `the solver ran into a trap (${cause})`);
        }
    }

    private view(): { data: number; count: number } {
        // Addresses above 2 GiB arrive as negative numbers.
        return {
            data: this.raw("boundary_view_data", []) >>> 0,
            count: this.raw("boundary_view_count", []) >>> 0,
        };
    }
}
