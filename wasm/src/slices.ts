// Long work in slices, between which other events are handled: among these, that it is to end.
import type { Core, Handle } from "./core.js";
import { CancelledError, javaScriptError } from "./errors.js";
import type { CallOptions } from "./types.js";

/** About how many milliseconds a slice takes. */
export const defaultSlice = 15;

/**
 * Resolves after other events had their turn. Not setTimeout(), which browsers delay by
 * milliseconds.
 */
export function pause(): Promise<void> {
    const { setImmediate } = globalThis as { setImmediate?: (callback: () => void) => void };
    if (setImmediate !== undefined) {
        return new Promise((resolve) => {
            setImmediate(resolve);
        });
    }
    return new Promise((resolve) => {
        const { port1, port2 } = new MessageChannel();
        port1.onmessage = () => {
            port1.close();
            resolve();
        };
        port2.postMessage(null);
    });
}

/** Pauses; throws where `signal` is aborted or the session disposed of by then. */
export async function checkpoint(
    signal: AbortSignal | undefined,
    isAlive: () => boolean,
): Promise<void> {
    // What has arrived already is handled in the second turn at the latest.
    await pause();
    await pause();
    assertNotDisposed(isAlive);
    if (signal?.aborted === true) {
        throw new CancelledError();
    }
}

export function assertNotDisposed(isAlive: () => boolean): void {
    if (!isAlive()) {
        throw javaScriptError("disposed", "the session was disposed of while it was at work");
    }
}

/**
 * Steps a job of the core, whose functions begin with `name`, to its end or until `signal` is
 * aborted; false in this case.
 */
export async function runToEnd(
    core: Core,
    name: string,
    job: Handle,
    { signal, onProgress }: CallOptions,
    isAlive: () => boolean,
): Promise<boolean> {
    let shown = 0;
    for (;;) {
        if (signal?.aborted === true) {
            return false;
        }
        const more = core.count(`${name}_step`, job, defaultSlice) === 1;
        const progress = core.number(`${name}_progress`, job);
        if (progress > shown) {
            shown = progress;
            onProgress?.(progress);
        }
        if (!more) {
            return true;
        }
        await pause();
        assertNotDisposed(isAlive);
    }
}
