import type {
    Algorithm,
    ExportFormat,
    LandmarkDoubt,
    LayoutInfo,
    MeshArrays,
    PathShape,
    UncheckedMesh,
} from "layout-embedding";
import type { Example } from "../examples/index.js";
import type { Shape } from "../gallery/catalogue.js";
import { aligned, areFarApart } from "./alignment.js";
import { Batch, pairFiles } from "./batch.js";
import {
    algorithmWords,
    causeAndAdvice,
    comparisonWords,
    pathSettingWords,
    reshapeWords,
    titleOf,
} from "./describe.js";
import type { Engine, Worker } from "./engine.js";
import { assignRoles, look } from "./files.js";
import { LandmarkEditor, unsolved } from "./landmark_editor.js";
import { completeIds, missingLandmarks, noLandmarks, placedLandmarks } from "./landmarks.js";
import { Mapping } from "./mapping.js";
import { landmarksOf, lineOf, meshPlace } from "./places.js";
import type { Store } from "./store.js";
import {
    startedActivity,
    type AppState,
    type Display,
    type Item,
    type Origin,
    type PathSettings,
    type Problem,
    type Tab,
} from "./state.js";
import { QuadPreview } from "./quad_preview.js";
import { boundaryRemedy, layoutRemedy, meshRemedy } from "./remedies.js";
import { RouteEditor } from "./route_editor.js";
import { droppedWords, fits } from "./routes.js";
import { savedRest, type SavedWork } from "./saved_work.js";
import { heuristicOptions } from "./solve_options.js";
import { Solving } from "./solving.js";
import { inputOf, nameOf, type Role, type Source } from "./sources.js";
import { Workshop } from "./workshop.js";

/** The heuristics that the result is compared with. */
const heuristics: readonly Algorithm[] = ["greedy", "praun", "kraevoy", "schreiner"];

const nothingSolved = { ...unsolved, highlight: null, selected: null } as const;

/**
 * Everything that can happen to the state. Actions run one after the other: one that comes while a
 * solve is running ends that solve first.
 */
export class Actions {
    readonly landmarks: LandmarkEditor;
    readonly routes: RouteEditor;
    readonly quadMesh: QuadPreview;
    readonly map: Mapping;
    private readonly solving: Solving;
    private readonly batch: Batch;
    private readonly sources: Partial<Record<Role, Source>> = {};
    private queue: Promise<void> = Promise.resolve();
    private problemCount = 0;
    /** Whether the engine has the layout turned inside out; the state says what is wanted. */
    private layoutFlipped = false;

    constructor(
        private readonly store: Store<AppState>,
        private readonly engine: Engine,
        /** Starts a worker beside the engine's. */
        startWorker: () => Promise<Worker>,
    ) {
        this.solving = new Solving(store, engine, (error) =>
            this.report(error, { remedy: boundaryRemedy(error, this) }),
        );
        this.landmarks = new LandmarkEditor(store, {
            dragged: (id) => void this.solving.preview(id),
            edited: (wasSolved) => this.afterEdit(wasSolved),
        });
        this.routes = new RouteEditor(store, this.landmarks, () =>
            store.get().live ? this.queue : this.solve(),
        );
        this.quadMesh = new QuadPreview(store, new Workshop(engine, startWorker));
        this.map = new Mapping(store, new Workshop(engine, startWorker, true));
        this.batch = new Batch(engine, (entries, running) => {
            const { batch } = store.get();
            if (batch) store.update({ batch: { ...batch, entries, running } });
        });
    }

    /** Loads an example and solves it. */
    openExample(example: Example): Promise<void> {
        return this.enqueue(async () => {
            this.startAnew({ kind: "example", name: example.name });
            const { layout, target, landmarks } = example.make();
            if (!(await this.load("layout", layout)) || !(await this.load("target", target)))
                return;
            this.store.update({ landmarks: placedLandmarks(landmarks, "example") });
            await this.solving.run();
        });
    }

    /**
     * Loads a shape of the gallery and solves it: with the layout that its own landmarks make, or
     * with the layout there is, from another shape of its class.
     */
    openShape(shape: Shape, keepLayout = false): Promise<void> {
        return this.enqueue(async () => {
            const opened = await this.attempt(`Fetching ${shape.title}`, () => shape.open());
            if (!opened) return;
            const { quads, layout } = this.store.get();
            const keep = keepLayout && layout?.vertexCount === opened.landmarks.length;
            this.startAnew({ kind: "shape", name: shape.id });
            if (!(await this.load("target", opened.target))) return;
            const landmarks = placedLandmarks(opened.landmarks, "shape", opened.names);
            if (!keep && !(await this.makeLayout(opened.landmarks, quads, `${shape.title} layout`)))
                return;
            this.store.update({ landmarks });
            await this.solving.run();
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
            this.startAnew(null);
            this.store.update({ notices: roles.reason ? [roles.reason] : [] });
            if (roles.layout && !(await this.load("layout", roles.layout))) return;
            if (roles.target && !(await this.load("target", roles.target))) return;
            if (roles.landmarks) await this.readLandmarks(roles.landmarks);
            else if (roles.layout || roles.target) await this.guessLandmarks();
        });
    }

    /** One file for one role. */
    openAs(role: Role, source: Source): Promise<void> {
        return this.enqueue(async () => {
            this.startAnew(null);
            if (await this.load(role, source)) await this.guessLandmarks();
        });
    }

    openLandmarks(file: File): Promise<void> {
        return this.enqueue(() => this.readLandmarks(file));
    }

    /** Work that was put away: everything as it was; what was solved is solved again. */
    restore(saved: SavedWork): Promise<void> {
        return this.enqueue(async () => {
            const { repair, options, quads, making, tab } = saved;
            this.startAnew(saved.origin);
            this.store.update({ repair, options, quads, making, tab, routes: [] });
            // Either is of use without the other.
            const isTarget = !saved.target || (await this.load("target", saved.target));
            const isLayout = !saved.layout || (await this.load("layout", saved.layout));
            if (!isTarget || !isLayout) return;
            if (saved.landmarks) this.store.update({ landmarks: saved.landmarks });
            const { layout, landmarks } = this.store.get();
            if (layout && landmarks)
                this.store.update({
                    routes: saved.routes.filter((rule) => fits(rule, layout, landmarks)),
                });
            if (layout) this.quadMesh.restore(saved.quadMesh, layout);
            await this.map.restore(saved).catch((error: unknown) => this.report(error));
            if (saved.making) await this.rebuildLayout();
            else if (saved.solved) await this.solving.run();
        });
    }

    /** What restore() needs to bring everything back. */
    saved(): SavedWork {
        const { layout = null, target = null } = this.sources;
        const second = this.store.get().map.other?.saved ?? null;
        return { layout, target, second, ...savedRest(this.store.get()) };
    }

    /** Another target for the layout there is, solved. */
    openTarget(target: File, landmarks: File | null): Promise<void> {
        return this.enqueue(async () => {
            this.startAnew(null);
            if (!(await this.load("target", target))) return;
            if (landmarks) await this.readLandmarks(landmarks);
            else await this.guessLandmarks();
            await this.solving.run();
        });
    }

    /** Embeds the layout into many targets; what is open stays as it is. */
    async runBatch(files: readonly File[]): Promise<void> {
        const { layout, repair, options } = this.store.get();
        const { entries, leftOver } = pairFiles(files);
        if (!layout || entries.length === 0) return;
        const names = leftOver.map(({ name }) => name).join(", ");
        const batch = {
            layoutName: layout.name,
            note: names === "" ? "" : `No target is named like ${names}.`,
        };
        this.store.update({ batch: { ...batch, entries, running: true } });
        await this.batch.run(entries, repair, options);
    }

    cancelBatch(): void {
        this.batch.cancel();
    }

    /** The files of all embeddings of the batch, with a table. */
    batchFiles(): Readonly<Record<string, Uint8Array>> {
        return this.batch.packed(this.store.get().batch?.entries ?? []);
    }

    /** The layout becomes the target, the target the layout. */
    swap(): Promise<void> {
        return this.enqueue(async () => {
            const { layout, target } = this.sources;
            if (!layout || !target) return;
            this.startAnew(null);
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

    /** Starts or ends making the layout from landmarks on the target. */
    setMaking(making: boolean): Promise<void> {
        return this.enqueue(async () => {
            if (!this.store.get().target || making === this.store.get().making) return;
            this.landmarks.forget();
            if (!making) {
                this.store.update({ making, makingHint: null, placing: null });
                return;
            }
            delete this.sources.layout;
            this.store.update({
                ...nothingSolved,
                making,
                layout: null,
                landmarks: noLandmarks,
                placing: 0,
                makingHint: null,
                notices: [],
            });
            this.endRoutes("the layout is made anew");
            return Promise.resolve();
        });
    }

    /** Whether a layout that is made here gets quads; makes it again. */
    setQuads(quads: boolean): void {
        this.store.update({ quads });
        const { making, origin } = this.store.get();
        if (making) void this.enqueue(() => this.rebuildLayout());
        else if (origin?.kind === "shape") void this.enqueue(() => this.remakeLayout());
    }

    solve(): Promise<void> {
        return this.enqueue(() => this.solving.run());
    }

    /** Ends a running solve; what it has found stays. */
    cancel(): void {
        this.solving.cancel();
    }

    /** Runs the heuristics on the same problem and shows the worst of them beside the result. */
    compare(): Promise<void> {
        if (this.store.get().activity) return Promise.resolve();
        return this.enqueue(async () => {
            const { landmarks, layout, options } = this.store.get();
            const ids = landmarks && completeIds(landmarks);
            if (!ids || !layout) return;
            const contenders = [];
            for (const algorithm of heuristics) {
                const result = await this.attempt(`Trying ${algorithmWords(algorithm)}`, () =>
                    this.engine.solveBeside(ids, { ...heuristicOptions(options), algorithm }),
                );
                if (!result) return;
                contenders.push({ algorithm, result });
            }
            const costs = contenders.map(({ result }) => (result.refined ? result.cost : -1));
            const shown = Math.max(...costs) > 0 ? costs.indexOf(Math.max(...costs)) : null;
            const { result: optimum } = this.store.get();
            this.store.update({
                comparison: { contenders, shown },
                announcement: optimum ? comparisonWords(contenders, shown, optimum) : "",
            });
        });
    }

    /** Draws the paths that the edges would take alone, or the embedding's again. */
    toggleCandidates(): Promise<void> {
        if (this.store.get().activity) return Promise.resolve();
        return this.enqueue(async () => {
            const { candidates, result } = this.store.get();
            if (!result?.refined) return;
            if (candidates) {
                this.store.update({
                    candidates: { ...candidates, shown: !candidates.shown },
                    step: null,
                });
                return;
            }
            const found = await this.attempt("Looking for the paths of edges alone", () =>
                this.engine.candidatePaths(),
            );
            if (found) this.store.update({ candidates: { found, shown: true }, step: null });
        });
    }

    /** Shows one of the compared embeddings beside the result; null for the layout. */
    showContender(shown: number | null): void {
        const { comparison } = this.store.get();
        if (comparison) this.store.update({ comparison: { ...comparison, shown } });
    }

    /** Shows an improvement of the last solve by its place; null for the result. */
    showStep(step: number | null): void {
        const { candidates } = this.store.get();
        this.store.update({ step, candidates: candidates && { ...candidates, shown: false } });
    }

    /** The result in the formats of other programs, by file name; empty if there is none. */
    async exportFormats(
        formats: readonly ExportFormat[],
    ): Promise<Readonly<Record<string, Uint8Array>>> {
        try {
            return await this.engine.exportAs(formats);
        } catch (error) {
            this.report(error);
            return {};
        }
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

    /** What paths cost and where they have to run: an edit that can be taken back. */
    setPathSettings(change: Partial<PathSettings>): void {
        this.landmarks.setPathSettings(change, pathSettingWords(change));
    }

    /** How paths run; a result gets the shape without a new search. */
    setShape(shape: PathShape): void {
        this.setOptions({ shape });
        // A search that runs goes on.
        this.queue = this.queue
            .then(() => this.reshape())
            .catch((error: unknown) => this.report(error));
    }

    /** Changes the input into what it probably was meant to be. */
    mend({ vertices }: LandmarkDoubt): void {
        if (vertices) this.landmarks.exchange(...vertices);
        else this.landmarks.flip();
        if (!this.store.get().live) void this.solve();
    }

    setRepair(repair: boolean): void {
        this.store.update({ repair });
    }

    setAlign(align: boolean): void {
        this.store.update({ align });
    }

    setLive(live: boolean): void {
        this.store.update({ live });
    }

    highlight(item: Item | null): void {
        const { highlight } = this.store.get();
        if (item?.kind === highlight?.kind && item?.id === highlight?.id) return;
        this.store.update({ highlight: item });
    }

    select(item: Item | null): void {
        this.store.update({ selected: item });
    }

    openTab(tab: Tab): void {
        this.store.update({ tab });
    }

    show(change: Partial<Display>): void {
        this.store.update({ display: { ...this.store.get().display, ...change } });
    }

    dismiss(id: number): void {
        const { problems, shownPlace } = this.store.get();
        this.store.update({
            problems: problems.filter((p) => p.id !== id),
            shownPlace: shownPlace === id ? null : shownPlace,
        });
    }

    /** Shows where a problem lies; null for none. */
    showPlace(id: number | null): void {
        this.store.update({ shownPlace: id });
    }

    /** Says something that is worth a line, but no problem. */
    notice(text: string): void {
        this.store.update({ notices: [...this.store.get().notices, text] });
    }

    /** Shows something thrown as a problem. */
    report(error: unknown, more: Partial<Problem> = {}): void {
        const code = error instanceof Error && "code" in error ? String(error.code) : "internal";
        const message = error instanceof Error ? error.message : String(error);
        const { problems, landmarks, layout } = this.store.get();
        const problem: Problem = {
            id: ++this.problemCount,
            code,
            title: titleOf(code),
            ...causeAndAdvice(message),
            line: null,
            place: landmarksOf(error, landmarks, layout),
            about: null,
            remedy: null,
            ...more,
        };
        // The same sentence twice helps nobody.
        const others = problems.filter(({ cause }) => cause !== problem.cause);
        this.store.update({
            problems: [...others, problem],
            shownPlace: problem.place ? problem.id : null,
        });
    }

    /** Does something with a mesh that was refused; null if that failed, which is reported. */
    mended<Result>(
        role: Role,
        source: Source,
        mend: (mesh: UncheckedMesh) => Result,
    ): Promise<Result | null> {
        const options = { repair: this.store.get().repair };
        return this.attempt("Mending the mesh", async () =>
            mend(await this.engine.inspect(role, await inputOf(source), options)),
        );
    }

    private enqueue(task: () => Promise<void>): Promise<void> {
        this.solving.cancel();
        this.queue = this.queue.then(task).catch((error: unknown) => this.report(error));
        return this.queue;
    }

    private startAnew(origin: Origin | null): void {
        this.landmarks.forget();
        this.store.update({
            notices: [],
            origin,
            flipped: false,
            making: false,
            makingHint: null,
            placing: null,
        });
    }

    /** Does something with its name shown; null if it failed, which is reported. */
    private async attempt<Result>(
        phase: string,
        task: () => Promise<Result>,
        report: (error: unknown) => void | Promise<void> = (error) => this.report(error),
    ): Promise<Result | null> {
        this.store.update({ activity: startedActivity("loading", phase) });
        try {
            return await task();
        } catch (error) {
            await report(error);
            return null;
        } finally {
            this.store.update({ activity: null });
        }
    }

    private async load(role: Role, source: Source): Promise<boolean> {
        const options = { repair: this.store.get().repair };
        const loaded = await this.attempt(
            `Reading ${nameOf(source)}`,
            async () => {
                const input = await inputOf(source);
                if (role === "layout") {
                    const layout = await this.engine.loadLayout(input, options);
                    this.store.update({ ...nothingSolved, layout });
                    return layout;
                }
                const target = await this.engine.loadTarget(input, options);
                this.store.update({ ...nothingSolved, target });
                return target;
            },
            async (error) => {
                this.report(error, {
                    about: role,
                    remedy: meshRemedy(error, role, source, options.repair, this),
                    line: source instanceof File ? await lineOf(error, source) : null,
                    place: await meshPlace(error, role, nameOf(source), async () =>
                        this.engine.inspect(role, await inputOf(source), options),
                    ),
                });
            },
        );
        if (!loaded) return false;
        this.sources[role] = source;
        if (role === "layout") {
            this.layoutFlipped = false;
            this.store.update({ flipped: false });
        }
        const { notices, problems, layout, target, landmarks } = this.store.get();
        const names = landmarks?.names.length === layout?.vertexCount ? landmarks?.names : [];
        this.store.update({
            notices: [...notices, ...loaded.notes],
            // What was wrong with an earlier attempt at this role is settled.
            problems: problems.filter(({ about }) => about !== role),
            shownPlace: null,
            landmarks: layout && target ? missingLandmarks(layout.vertexCount, names) : null,
        });
        this.endRoutes(`there is another ${role}`);
        return true;
    }

    private endRoutes(why: string): void {
        const { routes } = this.store.get();
        if (routes.length === 0) return;
        this.store.update({ routes: [] });
        this.notice(droppedWords(routes, why));
    }

    /** Proximity where layout and target allow it; used after loading. */
    private async guessLandmarks(): Promise<void> {
        const { layout, target } = this.store.get();
        if (!layout || !target || layout.vertexCount > target.vertexCount) return;
        const align = areFarApart(layout, target);
        this.store.update({ align });
        if (align)
            this.notice(
                "Layout and target do not lie in one place: the layout was aligned to the target " +
                    "for its landmarks.",
            );
        await this.proximity();
    }

    private async proximity(): Promise<void> {
        await this.attempt(
            "Placing landmarks by proximity",
            async () => {
                const { layout, target, align } = this.store.get();
                const elsewhere = align && layout && target ? aligned(layout, target) : null;
                const { landmarks, notes } = await this.engine.landmarksByProximity(elsewhere);
                this.replaceLandmarks(landmarks, align ? "aligned" : "by proximity", notes);
            },
            (error) => this.report(error, { remedy: layoutRemedy(error, this) }),
        );
    }

    private async readLandmarks(file: File): Promise<void> {
        await this.attempt(`Reading ${file.name}`, async () => {
            const bytes = await file.arrayBuffer();
            const info = await this.engine.setLandmarks({ name: file.name, bytes });
            this.replaceLandmarks(info.landmarks, file.name, info.notes, info.names);
        });
    }

    private replaceLandmarks(
        ids: Uint32Array,
        source: string,
        notes: readonly string[],
        names: readonly string[] = [],
    ): void {
        const { notices, landmarks } = this.store.get();
        const known = names.length > 0 ? names : landmarks?.names;
        this.landmarks.replace(placedLandmarks(ids, source, known));
        this.store.update({ placing: null, notices: [...notices, ...notes] });
    }

    /** What an edit of the landmarks entails: in live mode, what was solved is solved again. */
    private afterEdit(wasSolved: boolean): void {
        const { making, live, landmarks, activity, flipped } = this.store.get();
        if (making) void this.enqueue(() => this.rebuildLayout());
        else if (flipped !== this.layoutFlipped)
            void this.enqueue(async () => {
                await this.turnLayout();
                if (live && wasSolved) await this.solving.run();
            });
        else if (live && wasSolved && landmarks && completeIds(landmarks)) void this.solve();
        // A solve for other landmarks is of no use any more.
        else if (activity?.kind === "solving") this.cancel();
    }

    /** Loads the layout inside out where that is wanted; its vertices keep their landmarks. */
    private async turnLayout(): Promise<void> {
        const { layout, flipped } = this.store.get();
        if (!layout || flipped === this.layoutFlipped) return;
        const source: MeshArrays = {
            name: layout.name,
            positions: layout.positions,
            corners: turnedFaces(layout),
            offsets: layout.offsets,
        };
        const turned = await this.attempt("Turning the layout", () =>
            this.engine.loadLayout(source, {}),
        );
        if (!turned) return;
        this.sources.layout = source;
        this.layoutFlipped = flipped;
        this.store.update({ ...nothingSolved, layout: turned });
    }

    /** Gives the result the shape that is wanted. */
    private async reshape(): Promise<void> {
        const { result, options } = this.store.get();
        if (!result?.refined) return;
        const { shape } = options;
        const reshaped = await this.attempt(reshapeWords[shape], () => this.engine.reshape(shape));
        if (reshaped) this.store.update({ result: reshaped, step: null });
    }

    /** Makes the layout of the landmarks on the target, while it is being made. */
    private async rebuildLayout(): Promise<void> {
        const { landmarks, making, quads } = this.store.get();
        const ids = landmarks && completeIds(landmarks);
        if (!making || !landmarks) return;
        if (!ids) {
            delete this.sources.layout;
            this.store.update({ layout: null, makingHint: null });
            return;
        }
        try {
            const made = await this.engine.templateLayout(ids, { quads, numbering: "loaded" });
            const source: MeshArrays = { ...made, name: "layout made here" };
            const layout = await this.engine.loadLayout(source, {});
            this.sources.layout = source;
            this.store.update({ layout, makingHint: null });
        } catch (error) {
            delete this.sources.layout;
            const makingHint = error instanceof Error ? error.message : String(error);
            this.store.update({ layout: null, makingHint });
        }
    }

    /** Makes the layout of the gallery's shape again, with or without quads. */
    private async remakeLayout(): Promise<void> {
        const { landmarks, quads, origin, layout } = this.store.get();
        const ids = landmarks && completeIds(landmarks);
        if (!ids || origin?.kind !== "shape") return;
        if (!(await this.makeLayout(ids, quads, layout?.name ?? "layout"))) return;
        this.store.update({ landmarks });
        await this.solving.run();
    }

    /** A layout of the target and these landmarks, loaded. */
    private async makeLayout(ids: Uint32Array, quads: boolean, name: string): Promise<boolean> {
        const made = await this.attempt("Making a layout of the landmarks", () =>
            this.engine.templateLayout(ids, { quads, numbering: "loaded" }),
        );
        if (!made) return false;
        const { positions, corners, offsets } = made;
        return this.load("layout", { positions, corners, offsets, name });
    }
}

/** The corners of a layout's faces, each face the other way round from its first corner. */
function turnedFaces({ corners, offsets }: LayoutInfo): Uint32Array {
    const turned = corners.slice();
    for (let f = 0; f + 1 < offsets.length; ++f)
        turned.subarray(offsets[f]! + 1, offsets[f + 1]).reverse();
    return turned;
}
