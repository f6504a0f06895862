// What the page's side (client.ts) and the worker's side (worker.ts) say to each other.
import type { EmbedProgress, EmbeddingSession } from "./types.js";

/** What a call under way is told of: the state of an embedding, or a share of the work. */
export type Progress = EmbedProgress | number;

/** A method of a session that runs in the worker. */
export type SessionMethod = keyof EmbeddingSession;

export type Request =
    /** Loads the module (from `wasm`, where given); must come first. */
    | {
          kind: "init";
          id: number;
          wasm: string | ArrayBuffer | Uint8Array | WebAssembly.Module | null;
      }
    /** Makes a session, known by the request's id from then on. */
    | { kind: "create"; id: number }
    /**
     * `abortable`: the last argument are options, to which signal and onProgress are added;
     * `aborted`: by a signal that is aborted already.
     */
    | {
          kind: "call";
          id: number;
          session: number;
          method: SessionMethod;
          args: unknown[];
          abortable: boolean;
          aborted: boolean;
      }
    /** Aborts a call under way. */
    | { kind: "abort"; id: number };

export type Reply =
    | { kind: "value"; id: number; value: unknown }
    | { kind: "error"; id: number; error: ErrorRecord }
    | { kind: "progress"; id: number; progress: Progress };

/** A LayoutError without its class, which messages lose. */
export interface ErrorRecord {
    code: string;
    message: string;
    details: Readonly<Record<string, number>>;
}

/** The buffers of all typed arrays in a value of plain objects and arrays, each once. */
export function buffersIn(value: unknown, found = new Set<ArrayBuffer>()): ArrayBuffer[] {
    if (ArrayBuffer.isView(value)) {
        if (value.buffer instanceof ArrayBuffer) {
            found.add(value.buffer);
        }
    } else if (Array.isArray(value)) {
        // Lists of numbers are long and hold nothing.
        if (typeof value[0] === "object") {
            value.forEach((item) => buffersIn(item, found));
        }
    } else if (typeof value === "object" && value !== null) {
        Object.values(value).forEach((item) => buffersIn(item, found));
    }
    return [...found];
}
