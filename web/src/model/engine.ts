import type {
    CandidatePaths,
    DraggedPaths,
    EmbeddingSession,
    EmbedResult,
    ExportedFiles,
    ExportFormat,
    LandmarkInput,
    LandmarkOptions,
    LandmarksInfo,
    LayoutInfo,
    LoadOptions,
    MeshArrays,
    MeshInput,
    PathShape,
    SolveOptions,
    TargetInfo,
    TargetLoadOptions,
    TemplateLayout,
    TemplateOptions,
    UncheckedMesh,
} from "layout-embedding";
import { CancelledError } from "layout-embedding/worker";

/** A worker of the package, and how to end it from outside. */
export interface Worker {
    readonly createSession: () => Promise<EmbeddingSession>;
    readonly terminate: () => void;
}

/** What a call comes to, also where its end has to be waited for after a cancel. */
export async function bestOf<Made>(call: Promise<Made>): Promise<Made> {
    try {
        return await call;
    } catch (error) {
        if (error instanceof CancelledError) return (await error.late) as Made;
        throw error;
    }
}

interface Running {
    readonly worker: Worker;
    readonly main: EmbeddingSession;
    /** For solves that must not replace the result: heuristics to compare with, previews. */
    side: Promise<EmbeddingSession> | null;
}

/** After one of these the worker has to be replaced. */
const fatal = new Set([
    "crashed",
    "workerFailed",
    "workerTerminated",
    "moduleNotLoaded",
    "disposed",
]);

const codeOf = (error: unknown): string =>
    error instanceof Error && "code" in error ? String(error.code) : "";

/** Whether the worker that this came from is of no use any more. */
export const isFatal = (error: unknown): boolean => fatal.has(codeOf(error));

/** Whether something ended because it was ended on purpose. */
export const isStopped = (error: unknown): boolean =>
    error instanceof CancelledError || codeOf(error) === "disposed";

/**
 * The solver as the page sees it: the package's session, started on first use, and started anew
 * with the same input when it has crashed, so that a crash loses nothing that was loaded.
 */
export class Engine {
    private running: Promise<Running> | null = null;
    private layout: [MeshInput, LoadOptions] | null = null;
    private target: [MeshInput, LoadOptions] | null = null;
    /** As loaded, after any repair. */
    private landmarks: Uint32Array | null = null;
    /** Those of the embedding that the main session has; null while it has none. */
    private solvedFor: Uint32Array | null = null;

    constructor(private readonly start: () => Promise<Worker>) {}

    async loadLayout(input: MeshInput, options: LoadOptions): Promise<LayoutInfo> {
        const info = await this.use(({ main }) => main.loadLayout(input, options));
        this.layout = [input, options];
        this.landmarks = this.solvedFor = null;
        await this.endSide();
        return info;
    }

    async loadTarget(input: MeshInput, options: LoadOptions): Promise<TargetInfo> {
        const info = await this.use(({ main }) => main.loadTarget(input, options));
        this.target = [input, options];
        this.landmarks = this.solvedFor = null;
        await this.endSide();
        return info;
    }

    async setLandmarks(
        input: LandmarkInput,
        options: LandmarkOptions = {},
    ): Promise<LandmarksInfo> {
        const info = await this.use(({ main }) => main.setLandmarks(input, options));
        this.landmarks = info.landmarks;
        return info;
    }

    /** Makes sure that these are the landmarks, as loaded. */
    async useLandmarks(ids: Uint32Array): Promise<void> {
        const { landmarks } = this;
        if (landmarks?.length === ids.length && landmarks.every((vertex, i) => vertex === ids[i]))
            return;
        await this.setLandmarks(ids, { numbering: "loaded" });
    }

    /** By proximity of the layout, or of another one with the same vertices somewhere else. */
    async landmarksByProximity(elsewhere: MeshArrays | null = null): Promise<LandmarksInfo> {
        const info = await this.use(({ worker, main }) =>
            elsewhere ? this.landmarksNear(elsewhere, worker, main) : main.landmarksByProximity(),
        );
        this.landmarks = info.landmarks;
        return info;
    }

    private async landmarksNear(
        layout: MeshArrays,
        worker: Worker,
        main: EmbeddingSession,
    ): Promise<LandmarksInfo> {
        const session = await worker.createSession();
        try {
            await session.loadLayout(layout);
            if (this.target) await session.loadTarget(...this.target);
            const { landmarks } = await session.landmarksByProximity();
            return await main.setLandmarks(landmarks, { numbering: "loaded" });
        } finally {
            await session.dispose().catch(() => undefined);
        }
    }

    templateLayout(landmarks: LandmarkInput, options: TemplateOptions): Promise<TemplateLayout> {
        return this.use(({ main }) => main.templateLayout(landmarks, options));
    }

    async solve(options: SolveOptions): Promise<EmbedResult> {
        this.solvedFor = null;
        const result = await this.use(({ main }) => bestOf(main.solve(options)));
        if (result.refined) this.solvedFor = result.landmarks;
        return result;
    }

    /** Solves beside the main session, whose result stays; landmarks as loaded. */
    solveBeside(landmarks: Uint32Array, options: SolveOptions): Promise<EmbedResult> {
        return this.use(async (running) => {
            running.side ??= this.sideSession(running.worker);
            const session = await running.side;
            await session.setLandmarks(landmarks, { numbering: "loaded" });
            return session.solve(options);
        });
    }

    /** Embeds the layout into another target, apart from everything else; no landmarks: by proximity. */
    solveElsewhere(
        target: MeshInput,
        landmarks: LandmarkInput | null,
        load: LoadOptions,
        options: SolveOptions,
    ): Promise<{ result: EmbedResult; files: ExportedFiles | null }> {
        return this.use(async ({ worker }) => {
            const session = await worker.createSession();
            try {
                if (this.layout) await session.loadLayout(...this.layout);
                await session.loadTarget(target, load);
                await (landmarks
                    ? session.setLandmarks(landmarks)
                    : session.landmarksByProximity());
                const result = await bestOf(session.solve(options));
                return { result, files: result.refined ? await session.exportFiles() : null };
            } finally {
                await session.dispose().catch(() => undefined);
            }
        });
    }

    /** Another shape for the paths of the last solve(). */
    reshape(shape: PathShape): Promise<EmbedResult> {
        return this.use(({ main }) => main.reshape(shape));
    }

    /** The paths that the edges of the last solve() would take alone. */
    candidatePaths(): Promise<CandidatePaths> {
        return this.use(({ main }) => main.candidatePaths());
    }

    /**
     * The embedding of the last solve() with landmark `id` elsewhere; null where it does not
     * follow, or any other landmark is not where it was.
     */
    async follow(id: number, landmarks: Uint32Array): Promise<DraggedPaths | null> {
        const { solvedFor } = this;
        const vertex = landmarks[id];
        const fits =
            solvedFor?.length === landmarks.length &&
            solvedFor.every((v, i) => i === id || v === landmarks[i]);
        if (!fits || vertex === undefined) return null;
        return this.use(({ main }) => main.dragLandmark(id, vertex));
    }

    /** A mesh that was refused, as it stands in its file. */
    inspect(
        role: "layout" | "target",
        input: MeshInput,
        options: LoadOptions,
    ): Promise<UncheckedMesh> {
        return this.use(({ main }) => main.inspect(role, input, options));
    }

    exportFiles(): Promise<ExportedFiles> {
        return this.use(({ main }) => main.exportFiles());
    }

    exportAs(formats: readonly ExportFormat[]): Promise<Record<string, Uint8Array>> {
        return this.use(({ main }) => main.exportAs(formats));
    }

    private async use<Result>(call: (running: Running) => Promise<Result>): Promise<Result> {
        this.running ??= this.restored();
        const current = this.running;
        try {
            return await call(await current);
        } catch (error) {
            if (isFatal(error) && this.running === current) {
                this.running = this.solvedFor = null;
                current.then(({ worker }) => worker.terminate()).catch(() => undefined);
            }
            throw error;
        }
    }

    private async restored(): Promise<Running> {
        const worker = await this.start();
        const main = await worker.createSession();
        await this.loadInto(main);
        if (this.landmarks) await main.setLandmarks(this.landmarks, { numbering: "loaded" });
        return { worker, main, side: null };
    }

    private async sideSession(worker: Worker): Promise<EmbeddingSession> {
        const session = await worker.createSession();
        await this.loadInto(session);
        return session;
    }

    /** Gives a session of another worker the layout and the target. */
    async loadInto(
        session: EmbeddingSession,
        more: TargetLoadOptions = {},
    ): Promise<TargetInfo | null> {
        const [layout, target] = [this.layout, this.target];
        const { signal } = more;
        if (layout)
            await session.loadLayout(layout[0], { ...layout[1], ...(signal && { signal }) });
        return target && session.loadTarget(target[0], { ...target[1], ...more });
    }

    /** New input makes the side session worthless; its memory goes back. */
    private async endSide(): Promise<void> {
        const running = await this.running;
        const side = running?.side;
        if (!running || !side) return;
        running.side = null;
        await side.then((session) => session.dispose()).catch(() => undefined);
    }
}
