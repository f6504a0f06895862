// The worker's side: sessions by id, several jobs at a time, each in slices. The other side is
// client.ts, which starts this file.
import type { MessagePort } from "node:worker_threads";
import { asLayoutError, javaScriptError } from "./errors.js";
import { init } from "./loader.js";
import { buffersIn, type Progress, type Reply, type Request } from "./protocol.js";
import { Session } from "./session.js";

type Send = (reply: Reply, transfer: ArrayBuffer[]) => void;

const sessions = new Map<number, Session>();
const aborts = new Map<number, AbortController>();

async function answer(request: Request, send: Send): Promise<void> {
    if (request.kind === "abort") {
        aborts.get(request.id)?.abort();
        return;
    }
    const { id } = request;
    try {
        const value = await perform(request, send);
        send({ kind: "value", id, value }, buffersIn(value));
    } catch (reason) {
        const { code, message, details } = asLayoutError(reason);
        send({ kind: "error", id, error: { code, message, details } }, []);
    } finally {
        aborts.delete(id);
    }
}

async function perform(request: Exclude<Request, { kind: "abort" }>, send: Send): Promise<unknown> {
    switch (request.kind) {
        case "init":
            return init(request.wasm === null ? {} : { wasm: request.wasm });
        case "create":
            sessions.set(request.id, await Session.create());
            return undefined;
        case "call": {
            const session = sessions.get(request.session);
            if (session === undefined) {
                if (request.method === "dispose") {
                    return undefined;
                }
                throw javaScriptError("disposed", "the session cannot be used any more");
            }
            if (request.method === "dispose") {
                sessions.delete(request.session);
            }
            const methods = session as unknown as Record<
                string,
                (...args: unknown[]) => Promise<unknown>
            >;
            const args = [...request.args];
            if (request.abortable) {
                args.push({ ...(args.pop() as object), ...whileRunning(request, send) });
            }
            return methods[request.method]?.(...args);
        }
    }
}

/** The options of a call that stand for what cannot be sent. */
function whileRunning({ id, aborted }: { id: number; aborted: boolean }, send: Send) {
    const abort = new AbortController();
    if (aborted) {
        abort.abort();
    }
    aborts.set(id, abort);
    return {
        signal: abort.signal,
        onProgress: (progress: Progress) => {
            send({ kind: "progress", id, progress }, buffersIn(progress));
        },
    };
}

/** What this file needs of a worker's global scope. */
interface Scope {
    postMessage(message: unknown, transfer: ArrayBuffer[]): void;
    addEventListener(type: "message", listener: (event: { data: Request }) => void): void;
}

async function start(): Promise<void> {
    const scope = globalThis as unknown as Partial<Scope>;
    if (scope.postMessage !== undefined && scope.addEventListener !== undefined) {
        const send: Send = (reply, transfer) => scope.postMessage?.(reply, transfer);
        scope.addEventListener("message", (event) => void answer(event.data, send));
        return;
    }
    // Not a literal, so that bundlers for the browser don't look for it.
    const name = "node:worker_threads";
    const { parentPort } = (await import(/* @vite-ignore */ name)) as {
        parentPort: MessagePort | null;
    };
    const send: Send = (reply, transfer) => parentPort?.postMessage(reply, transfer);
    parentPort?.on("message", (request: Request) => void answer(request, send));
}

void start();
