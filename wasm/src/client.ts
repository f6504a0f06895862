// The same API in a worker ("layout-embedding/worker"), so that a page stays responsive: in
// browsers a module worker, in Node a worker thread.
import type * as WorkerThreads from "node:worker_threads";
import { batchIn } from "./batch.js";
import { CancelledError, javaScriptError, LayoutError } from "./errors.js";
import type { Progress, Reply, Request, SessionMethod } from "./protocol.js";
import { embedIn, mapIn, templateIn } from "./sugar.js";
import type {
    CandidatePaths,
    DraggedPaths,
    BatchMember,
    BatchOptions,
    BatchRow,
    EmbeddingClaim,
    EmbeddingSession,
    EmbedOptions,
    EmbedProblem,
    EmbedResult,
    ExportedFiles,
    ExportFormat,
    ExportView,
    LandmarkInput,
    LandmarkOptions,
    LandmarksInfo,
    LayoutInfo,
    LoadOptions,
    MeshInput,
    PathShape,
    ReshapeOptions,
    QuadMesh,
    QuadOptions,
    QualityReport,
    SolveOptions,
    SurfaceMap,
    SurfaceMapOptions,
    SurfaceMapProblem,
    SurfacePoints,
    TargetInfo,
    TargetLoadOptions,
    TemplateLayout,
    TemplateOptions,
    TemplateProblem,
    UncheckedMesh,
    Violation,
} from "./types.js";

export { CancelledError, LayoutError } from "./errors.js";
export { mapFiles } from "./map_files.js";
export { facePatches, pathPoints } from "./unrefined.js";
export { algorithmNames, pathShapeNames } from "./names.js";
export type * from "./types.js";

/** How a worker is started. */
export interface WorkerOptions {
    /** Where core.wasm comes from: an address, its bytes, or compiled. Default: beside this file. */
    wasm?: string | URL | ArrayBuffer | Uint8Array | WebAssembly.Module;
}

interface Pending {
    resolve: (value: unknown) => void;
    reject: (reason: LayoutError) => void;
    onProgress: ((progress: Progress) => void) | undefined;
}

/** What of a call's options stays on this side. */
interface Local {
    signal?: AbortSignal;
    onProgress?: (progress: never) => void;
}

/** How many milliseconds an aborted call has for a result of its own. */
const patience = 50;

/** What both kinds of worker can do. */
interface Port {
    post(request: Request): void;
    terminate(): void;
}

interface PortEvents {
    onReply: (reply: Reply) => void;
    onFailure: (cause: string) => void;
}

/** Starts a worker and loads the module in it. */
export function createWorkerClient(options: WorkerOptions = {}): Promise<EmbeddingWorker> {
    return EmbeddingWorker.create(options);
}

/**
 * The functions and sessions of the package, in a worker of their own. Errors arrive as LayoutErrors;
 * a worker that is stopped from outside rejects what is pending with workerFailed.
 */
export class EmbeddingWorker {
    private readonly pending = new Map<number, Pending>();
    /** Per session: aborted calls whose promises are settled, but that the worker still ends. */
    private readonly ending = new Map<number, Promise<unknown>>();
    private port: Port | null = null;
    private lastId = 0;

    private constructor() {}

    /** Starts a worker and loads the module in it; rejects with a LayoutError if either fails. */
    static async create(options: WorkerOptions = {}): Promise<EmbeddingWorker> {
        const worker = new EmbeddingWorker();
        worker.port = await openPort({
            onReply: (reply) => {
                worker.receive(reply);
            },
            onFailure: (cause) => {
                worker.end(javaScriptError("workerFailed", `the worker failed (${cause})`));
            },
        });
        const { wasm } = options;
        const source = wasm instanceof URL ? wasm.href : (wasm ?? null);
        try {
            await worker.send((id) => ({ kind: "init", id, wasm: source }));
        } catch (reason) {
            worker.terminate();
            throw reason;
        }
        return worker;
    }

    /** A session in the worker; several can work at a time, taking turns. */
    async createSession(): Promise<EmbeddingSession> {
        let session = 0;
        await this.send((id) => {
            session = id;
            return { kind: "create", id };
        });
        return new WorkerSession((method, args, local) => this.call(session, method, args, local));
    }

    /** Embeds a layout into a target, as embed() of the package does, but in the worker. */
    async embed(problem: EmbedProblem, options: EmbedOptions = {}): Promise<EmbedResult> {
        const session = await this.createSession();
        try {
            return await embedIn(session, problem, options);
        } finally {
            // A terminated worker has no session left to dispose of.
            await session.dispose().catch(() => undefined);
        }
    }

    /** Maps two targets of a layout, as mapSurfaces() of the package does, but in the worker. */
    async mapSurfaces(
        problem: SurfaceMapProblem,
        options: EmbedOptions & SurfaceMapOptions = {},
    ): Promise<SurfaceMap> {
        const session = await this.createSession();
        try {
            return await mapIn(session, problem, options);
        } finally {
            await session.dispose().catch(() => undefined);
        }
    }

    /** One layout in many targets, as batch() of the package does, but in the worker. */
    async batch(
        layout: MeshInput,
        members: readonly BatchMember[],
        options: BatchOptions = {},
    ): Promise<BatchRow[]> {
        const session = await this.createSession();
        try {
            return await batchIn(session, layout, members, options);
        } finally {
            await session.dispose().catch(() => undefined);
        }
    }

    /** Makes a layout of a target, as templateLayout() of the package does, but in the worker. */
    async templateLayout(
        problem: TemplateProblem,
        options: TemplateOptions & LoadOptions = {},
    ): Promise<TemplateLayout> {
        const session = await this.createSession();
        try {
            return await templateIn(session, problem, options);
        } finally {
            await session.dispose().catch(() => undefined);
        }
    }

    /** Ends the worker at once; whatever is pending is rejected with workerTerminated. */
    terminate(): void {
        this.end(javaScriptError("workerTerminated", "the worker was terminated"));
    }

    private async call(
        session: number,
        method: SessionMethod,
        args: unknown[],
        local: Local | null,
    ): Promise<unknown> {
        const { signal, onProgress } = local ?? {};
        let abort = () => {};
        const start = () =>
            this.send(
                (id) => {
                    abort = () => this.port?.post({ kind: "abort", id });
                    const abortable = local !== null;
                    const aborted = signal?.aborted === true;
                    return { kind: "call", id, session, method, args, abortable, aborted };
                },
                onProgress as Pending["onProgress"],
            );
        const before = this.ending.get(session);
        // Only the end of a session need not wait for its calls.
        const reply = before === undefined || method === "dispose" ? start() : before.then(start);
        return signal === undefined
            ? reply
            : this.unlessAborted(session, reply, signal, () => {
                  abort();
              });
    }

    /** The reply, or soon after an abort a CancelledError. */
    private unlessAborted(
        session: number,
        reply: Promise<unknown>,
        signal: AbortSignal,
        abort: () => void,
    ): Promise<unknown> {
        return new Promise((resolve, reject) => {
            let timer: ReturnType<typeof setTimeout> | undefined;
            const onAbort = () => {
                abort();
                timer = setTimeout(() => {
                    const ended = reply.catch(() => undefined);
                    this.ending.set(session, ended);
                    void ended.then(() => {
                        if (this.ending.get(session) === ended) {
                            this.ending.delete(session);
                        }
                    });
                    reject(new CancelledError(reply));
                }, patience);
            };
            if (signal.aborted) {
                onAbort();
            } else {
                signal.addEventListener("abort", onAbort);
            }
            reply.then(resolve, reject).finally(() => {
                clearTimeout(timer);
                signal.removeEventListener("abort", onAbort);
            });
        });
    }

    private send(
        request: (id: number) => Request,
        onProgress?: Pending["onProgress"],
    ): Promise<unknown> {
        const { port } = this;
        if (port === null) {
            return Promise.reject(
                javaScriptError("workerTerminated", "the worker has been terminated"),
            );
        }
        const id = ++this.lastId;
        return new Promise((resolve, reject) => {
            this.pending.set(id, { resolve, reject, onProgress });
            try {
                port.post(request(id));
            } catch (reason) {
                this.pending.delete(id);
                const cause = reason instanceof Error ? reason.message : String(reason);
                reject(javaScriptError("invalidInput", `an argument cannot be sent (${cause})`));
            }
        });
    }

    private receive(reply: Reply): void {
        const pending = this.pending.get(reply.id);
        if (pending === undefined) {
            return;
        }
        if (reply.kind === "progress") {
            pending.onProgress?.(reply.progress);
            return;
        }
        this.pending.delete(reply.id);
        if (reply.kind === "value") {
            pending.resolve(reply.value);
        } else {
            const { code, message, details } = reply.error;
            pending.reject(
                code === "cancelled"
                    ? new CancelledError()
                    : new LayoutError(code, message, details),
            );
        }
    }

    private end(reason: LayoutError): void {
        this.port?.terminate();
        this.port = null;
        const rejected = [...this.pending.values()];
        this.pending.clear();
        for (const pending of rejected) {
            pending.reject(reason);
        }
    }
}

/** Calls a method of one session in the worker. */
type SessionCall = (
    method: SessionMethod,
    args: unknown[],
    local: Local | null,
) => Promise<unknown>;

/** A session in the worker, by messages. */
class WorkerSession implements EmbeddingSession {
    constructor(private readonly send: SessionCall) {}

    loadLayout(input: MeshInput, options: LoadOptions = {}): Promise<LayoutInfo> {
        return this.callWith(options, "loadLayout", input) as Promise<LayoutInfo>;
    }

    loadTarget(input: MeshInput, options: TargetLoadOptions = {}): Promise<TargetInfo> {
        return this.callWith(options, "loadTarget", input) as Promise<TargetInfo>;
    }

    inspect(
        role: "layout" | "target",
        input: MeshInput,
        options: LoadOptions = {},
    ): Promise<UncheckedMesh> {
        return this.callWith(options, "inspect", role, input) as Promise<UncheckedMesh>;
    }

    setLandmarks(input: LandmarkInput, options: LandmarkOptions = {}): Promise<LandmarksInfo> {
        return this.call("setLandmarks", [input, options]) as Promise<LandmarksInfo>;
    }

    landmarksByProximity(): Promise<LandmarksInfo> {
        return this.call("landmarksByProximity", []) as Promise<LandmarksInfo>;
    }

    templateLayout(
        landmarks: LandmarkInput,
        options: TemplateOptions = {},
    ): Promise<TemplateLayout> {
        return this.callWith(options, "templateLayout", landmarks) as Promise<TemplateLayout>;
    }

    solve(options: SolveOptions = {}): Promise<EmbedResult> {
        return this.callWith(options, "solve") as Promise<EmbedResult>;
    }

    reshape(shape: PathShape, options: ReshapeOptions = {}): Promise<EmbedResult> {
        return this.callWith(options, "reshape", shape) as Promise<EmbedResult>;
    }

    exportFiles(): Promise<ExportedFiles> {
        return this.call("exportFiles", []) as Promise<ExportedFiles>;
    }

    exportAs(
        formats: readonly ExportFormat[],
        view: ExportView = {},
    ): Promise<Record<string, Uint8Array>> {
        return this.call("exportAs", [formats, view]) as Promise<Record<string, Uint8Array>>;
    }

    quads(options: QuadOptions = {}): Promise<QuadMesh> {
        return this.callWith(options, "quads") as Promise<QuadMesh>;
    }

    setReference(): Promise<void> {
        return this.call("setReference", []) as Promise<void>;
    }

    mapFromReference(options: SurfaceMapOptions = {}): Promise<SurfaceMap> {
        return this.callWith(options, "mapFromReference") as Promise<SurfaceMap>;
    }

    mapPoints(from: "reference" | "target", points: SurfacePoints): Promise<SurfacePoints> {
        return this.call("mapPoints", [from, points]) as Promise<SurfacePoints>;
    }

    qualityReport(): Promise<QualityReport> {
        return this.call("qualityReport", []) as Promise<QualityReport>;
    }

    candidatePaths(): Promise<CandidatePaths> {
        return this.call("candidatePaths", []) as Promise<CandidatePaths>;
    }

    dragLandmark(layoutVertex: number, targetVertex: number): Promise<DraggedPaths | null> {
        return this.call("dragLandmark", [
            layoutVertex,
            targetVertex,
        ]) as Promise<DraggedPaths | null>;
    }

    check(claim: EmbeddingClaim): Promise<Violation[]> {
        return this.call("check", [claim]) as Promise<Violation[]>;
    }

    dispose(): Promise<void> {
        return this.call("dispose", []) as Promise<void>;
    }

    private call(method: SessionMethod, args: unknown[]): Promise<unknown> {
        return this.send(method, args, null);
    }

    /** A call that can be aborted; functions and signals cannot be sent. */
    private callWith(
        { signal, onProgress, ...plain }: Local,
        method: SessionMethod,
        ...args: unknown[]
    ): Promise<unknown> {
        const local = { ...(signal && { signal }), ...(onProgress && { onProgress }) };
        return this.send(method, [...args, plain], local);
    }
}

async function openPort(events: PortEvents): Promise<Port> {
    if (typeof Worker !== "undefined") {
        // Bundlers look for exactly this expression.
        const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
        worker.onmessage = (event: MessageEvent<Reply>) => {
            events.onReply(event.data);
        };
        worker.onmessageerror = () => {
            events.onFailure("a message could not be read");
        };
        worker.onerror = (event) => {
            event.preventDefault();
            events.onFailure(event.message || "its script could not be loaded");
        };
        return {
            post: (request) => {
                worker.postMessage(request);
            },
            terminate: () => {
                worker.terminate();
            },
        };
    }
    // Not literals, so that bundlers for the browser don't look for them.
    const module = "node:worker_threads";
    const file = "./worker.js";
    const threads = (await import(/* @vite-ignore */ module)) as typeof WorkerThreads;
    const thread = new threads.Worker(new URL(file, import.meta.url));
    thread.on("message", events.onReply);
    thread.on("error", (error: Error) => {
        events.onFailure(error.message);
    });
    // Whoever else ends it. After terminate() nothing is pending any more.
    thread.on("exit", (code: number) => {
        events.onFailure(`its thread ended with code ${String(code)}`);
    });
    return {
        post: (request) => {
            thread.postMessage(request);
        },
        terminate: () => {
            void thread.terminate();
        },
    };
}
