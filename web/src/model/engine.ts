import type {
    EmbeddingSession,
    EmbedResult,
    ExportedFiles,
    LandmarkInput,
    LandmarksInfo,
    LayoutInfo,
    LoadOptions,
    MeshInput,
    SolveOptions,
    TargetInfo,
} from "layout-embedding";

/** A session in a worker, and how to end that worker from outside. */
export interface WorkerSession {
    readonly session: EmbeddingSession;
    readonly terminate: () => void;
}

/** After one of these the worker has to be replaced. */
const fatal = new Set([
    "crashed",
    "workerFailed",
    "workerTerminated",
    "moduleNotLoaded",
    "disposed",
]);

/**
 * The solver as the page sees it: the package's session, started on first use, and started anew
 * with the same input when it has crashed, so that a crash loses nothing that was loaded.
 */
export class Engine {
    private worker: Promise<WorkerSession> | null = null;
    private layout: [MeshInput, LoadOptions] | null = null;
    private target: [MeshInput, LoadOptions] | null = null;
    private landmarks: LandmarkInput | "proximity" | null = null;

    constructor(private readonly start: () => Promise<WorkerSession>) {}

    async loadLayout(input: MeshInput, options: LoadOptions): Promise<LayoutInfo> {
        const info = await this.use((session) => session.loadLayout(input, options));
        this.layout = [input, options];
        this.landmarks = null;
        return info;
    }

    async loadTarget(input: MeshInput, options: LoadOptions): Promise<TargetInfo> {
        const info = await this.use((session) => session.loadTarget(input, options));
        this.target = [input, options];
        this.landmarks = null;
        return info;
    }

    async setLandmarks(input: LandmarkInput): Promise<LandmarksInfo> {
        const info = await this.use((session) => session.setLandmarks(input));
        this.landmarks = input;
        return info;
    }

    async landmarksByProximity(): Promise<LandmarksInfo> {
        const info = await this.use((session) => session.landmarksByProximity());
        this.landmarks = "proximity";
        return info;
    }

    solve(options: SolveOptions): Promise<EmbedResult> {
        return this.use((session) => session.solve(options));
    }

    exportFiles(): Promise<ExportedFiles> {
        return this.use((session) => session.exportFiles());
    }

    private async use<Result>(
        call: (session: EmbeddingSession) => Promise<Result>,
    ): Promise<Result> {
        this.worker ??= this.restored();
        const current = this.worker;
        try {
            return await call((await current).session);
        } catch (error) {
            const code = error instanceof Error && "code" in error ? String(error.code) : "";
            if (fatal.has(code) && this.worker === current) {
                this.worker = null;
                current.then(({ terminate }) => terminate()).catch(() => undefined);
            }
            throw error;
        }
    }

    private async restored(): Promise<WorkerSession> {
        const worker = await this.start();
        const { session } = worker;
        if (this.layout) await session.loadLayout(...this.layout);
        if (this.target) await session.loadTarget(...this.target);
        if (this.landmarks === "proximity") await session.landmarksByProximity();
        else if (this.landmarks) await session.setLandmarks(this.landmarks);
        return worker;
    }
}
