import type { MeshInput, SolveOptions } from "layout-embedding";
import type { Example } from "../examples/index.js";
import { improvingWords, phaseWords, titleOf } from "./describe.js";
import type { Engine } from "./engine.js";
import { assignRoles, look } from "./files.js";
import type { Activity, AppState, Item, Problem } from "./state.js";
import type { Store } from "./store.js";

/** The same file or arrays can be read again: file contents are fetched each time. */
export type Source = File | MeshInput;
type Role = "layout" | "target";

/** Errors that reading again with repair may get rid of. */
const repairable = new Set([
    "degenerateFace",
    "duplicateFace",
    "coincidentVertices",
    "unusedVertex",
]);

const nameOf = (source: Source): string => source.name ?? "mesh";

async function inputOf(source: Source): Promise<MeshInput> {
    return source instanceof File
        ? { name: source.name, bytes: await source.arrayBuffer() }
        : source;
}

/**
 * Everything that can happen to the state. Actions run one after the other: one that comes while a
 * solve is running ends that solve first.
 */
export class Actions {
    private readonly sources: Partial<Record<Role, Source>> = {};
    private queue: Promise<void> = Promise.resolve();
    private abort: AbortController | null = null;
    private problemCount = 0;

    constructor(
        private readonly store: Store<AppState>,
        private readonly engine: Engine,
    ) {}

    /** Loads an example and solves it. */
    openExample(example: Example): Promise<void> {
        return this.enqueue(async () => {
            this.store.update({ notices: [] });
            const { layout, target, landmarks } = example.make();
            if (!(await this.load("layout", layout)) || !(await this.load("target", target)))
                return;
            await this.attempt("Setting the landmarks", async () => {
                const { landmarks: ids } = await this.engine.setLandmarks(landmarks);
                this.store.update({ landmarks: { ids, source: "example" } });
            });
            await this.runSolve();
        });
    }

    /** Files of any kind in any order, as from a drop. */
    openFiles(files: readonly File[]): Promise<void> {
        if (files.length === 0) return Promise.resolve();
        return this.enqueue(async () => {
            const roles = await this.attempt("Looking at the files", async () =>
                assignRoles(await Promise.all(files.map(look))),
            );
            if (!roles) return;
            this.store.update({ notices: roles.reason ? [roles.reason] : [] });
            if (roles.layout && !(await this.load("layout", roles.layout))) return;
            if (roles.target && !(await this.load("target", roles.target))) return;
            if (roles.landmarks) await this.readLandmarks(roles.landmarks);
            else await this.guessLandmarks();
        });
    }

    /** One file for one role. */
    openAs(role: Role, source: Source): Promise<void> {
        return this.enqueue(async () => {
            this.store.update({ notices: [] });
            if (await this.load(role, source)) await this.guessLandmarks();
        });
    }

    openLandmarks(file: File): Promise<void> {
        return this.enqueue(() => this.readLandmarks(file));
    }

    /** The layout becomes the target, the target the layout. */
    swap(): Promise<void> {
        return this.enqueue(async () => {
            const { layout, target } = this.sources;
            if (!layout || !target) return;
            this.store.update({ notices: [] });
            const before = { ...this.sources };
            if ((await this.load("layout", target)) && (await this.load("target", layout))) {
                await this.guessLandmarks();
            } else if (before.layout && this.sources.layout !== before.layout) {
                // Half a swap is no use: take the first half back.
                await this.load("layout", before.layout);
                await this.guessLandmarks();
            }
        });
    }

    landmarksByProximity(): Promise<void> {
        return this.enqueue(() => this.proximity());
    }

    solve(): Promise<void> {
        return this.enqueue(() => this.runSolve());
    }

    /** Ends a running solve; what it has found stays. */
    cancel(): void {
        const { activity } = this.store.get();
        if (!this.abort || activity?.kind !== "solving") return;
        this.abort.abort();
        this.store.update({ activity: { ...activity, cancelling: true } });
    }

    /** The files of the result, by name; empty if there is none. */
    async exportFiles(): Promise<Readonly<Record<string, Uint8Array>>> {
        try {
            return { ...(await this.engine.exportFiles()) };
        } catch (error) {
            this.report(error);
            return {};
        }
    }

    setOptions(change: Partial<AppState["options"]>): void {
        this.store.update({ options: { ...this.store.get().options, ...change } });
    }

    setRepair(repair: boolean): void {
        this.store.update({ repair });
    }

    highlight(item: Item | null): void {
        const { highlight } = this.store.get();
        if (item?.kind === highlight?.kind && item?.id === highlight?.id) return;
        this.store.update({ highlight: item });
    }

    show(
        change: Partial<
            Pick<AppState, "layoutShown" | "patchesShown" | "wireframe" | "camerasLinked">
        >,
    ): void {
        this.store.update(change);
    }

    dismiss(id: number): void {
        this.store.update({ problems: this.store.get().problems.filter((p) => p.id !== id) });
    }

    /** Shows something thrown as a problem. */
    report(error: unknown, remedy: Problem["remedy"] = null): void {
        const code = error instanceof Error && "code" in error ? String(error.code) : "internal";
        const message = error instanceof Error ? error.message : String(error);
        const problem = { id: ++this.problemCount, code, title: titleOf(code), message, remedy };
        // The same sentence twice helps nobody.
        const others = this.store.get().problems.filter((p) => p.message !== message);
        this.store.update({ problems: [...others, problem] });
    }

    private enqueue(task: () => Promise<void>): Promise<void> {
        this.cancel();
        this.queue = this.queue.then(task).catch((error: unknown) => this.report(error));
        return this.queue;
    }

    /** Does something with its name shown; null if it failed, which is reported. */
    private async attempt<Result>(
        phase: string,
        task: () => Promise<Result>,
        remedy: (error: unknown) => Problem["remedy"] = () => null,
    ): Promise<Result | null> {
        this.store.update({ activity: activity("loading", phase) });
        try {
            return await task();
        } catch (error) {
            this.report(error, remedy(error));
            return null;
        } finally {
            this.store.update({ activity: null });
        }
    }

    private async load(role: Role, source: Source): Promise<boolean> {
        const loaded = await this.attempt(
            `Reading ${nameOf(source)}`,
            async () => {
                const input = await inputOf(source);
                const options = { repair: this.store.get().repair };
                if (role === "layout") {
                    const layout = await this.engine.loadLayout(input, options);
                    this.store.update({ ...nothingSolved, layout });
                    return layout;
                }
                const target = await this.engine.loadTarget(input, options);
                this.store.update({ ...nothingSolved, target });
                return target;
            },
            (error) => this.repairRemedy(role, source, error),
        );
        if (!loaded) return false;
        this.sources[role] = source;
        const { notices, problems } = this.store.get();
        this.store.update({
            notices: [...notices, ...loaded.notes],
            // What was wrong with an earlier attempt at this role is settled.
            problems: problems.filter((p) => p.remedy === null),
        });
        return true;
    }

    private repairRemedy(role: Role, source: Source, error: unknown): Problem["remedy"] {
        if (this.store.get().repair || !(error instanceof Error && "code" in error)) return null;
        if (!repairable.has(String(error.code))) return null;
        return {
            label: "Repair and read again",
            apply: () => {
                this.setRepair(true);
                void this.openAs(role, source);
            },
        };
    }

    /** Proximity where layout and target allow it; used after loading. */
    private async guessLandmarks(): Promise<void> {
        const { layout, target } = this.store.get();
        if (layout && target && layout.vertexCount <= target.vertexCount) await this.proximity();
    }

    private async proximity(): Promise<void> {
        await this.attempt("Placing landmarks by proximity", async () => {
            const { landmarks, notes } = await this.engine.landmarksByProximity();
            this.setLandmarks(landmarks, "by proximity", notes);
        });
    }

    private async readLandmarks(file: File): Promise<void> {
        await this.attempt(`Reading ${file.name}`, async () => {
            const bytes = await file.arrayBuffer();
            const { landmarks, notes } = await this.engine.setLandmarks({ name: file.name, bytes });
            this.setLandmarks(landmarks, file.name, notes);
        });
    }

    private setLandmarks(ids: Uint32Array, source: string, notes: readonly string[]): void {
        const { notices } = this.store.get();
        this.store.update({
            ...nothingSolved,
            landmarks: { ids, source },
            notices: [...notices, ...notes],
        });
    }

    private async runSolve(): Promise<void> {
        const { layout, target, landmarks, options } = this.store.get();
        if (!layout || !target || !landmarks) return;
        this.abort = new AbortController();
        this.store.update({
            activity: activity("solving", phaseWords.prepare),
            result: null,
            livePaths: null,
            problems: [],
        });
        const request: SolveOptions = {
            gap: options.gap,
            seed: options.seed,
            signal: this.abort.signal,
            onProgress: ({ phase, progress, cost, lowerBound, paths }) => {
                const { activity: current } = this.store.get();
                if (!current) return;
                // Once there is an embedding, nobody knows how long it takes to find a better one.
                const improving = phase === "search" && Number.isFinite(cost);
                this.store.update({
                    activity: {
                        ...current,
                        phase: improving ? improvingWords : phaseWords[phase],
                        progress: improving ? null : progress,
                        cost,
                        lowerBound,
                    },
                    ...(paths ? { livePaths: paths } : {}),
                });
            },
        };
        if (options.timeLimit !== null) request.timeLimit = options.timeLimit;
        try {
            this.store.update({ result: await this.engine.solve(request) });
        } catch (error) {
            this.report(error);
        } finally {
            this.abort = null;
            this.store.update({ activity: null });
        }
    }
}

/** A change of layout, target or landmarks makes everything solved before meaningless. */
const nothingSolved = { landmarks: null, result: null, livePaths: null, highlight: null } as const;

function activity(kind: Activity["kind"], phase: string): Activity {
    return {
        kind,
        phase,
        progress: null,
        startedAt: performance.now(),
        cost: Infinity,
        lowerBound: 0,
        cancelling: false,
    };
}
