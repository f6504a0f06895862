// The core of the interface: a layout, a target, landmarks, and what is solved with them, in an
// instance of the WebAssembly module of its own. Disposing of the session frees all its memory.
import { candidatePaths } from "./candidates.js";
import { Core, type Handle } from "./core.js";
import { LandmarkDrag } from "./drag.js";
import { javaScriptError, LayoutError } from "./errors.js";
import { checkClaim } from "./claim.js";
import {
    embeddingDocument,
    exportedFiles,
    type EmbeddingDocument,
    type Exportable,
    type InputRecord,
} from "./files.js";
import { exportJob, refinedObj } from "./formats.js";
import { createJob, jobOptions, readResult, reshapeJob, runJob, type JobOptions } from "./job.js";
import type { InitOptions } from "./loader.js";
import { imagesOf, keepEmbedding, makeMap, readMap } from "./maps.js";
import {
    arraysOf,
    byteArray,
    idArray,
    readMesh,
    textureCoordinatesOf,
    type LoadedMesh,
} from "./mesh.js";
import { makeQuads } from "./quads.js";
import { qualityReport } from "./quality.js";
import { checkpoint } from "./slices.js";
import type {
    CandidatePaths,
    DraggedPaths,
    EmbeddingClaim,
    EmbeddingSession,
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
    SurfacePoints,
    TargetInfo,
    TargetLoadOptions,
    TemplateLayout,
    TemplateOptions,
    UncheckedMesh,
    Violation,
} from "./types.js";

/** What the session holds of a layout or target. Nothing of it is handed out but as a copy. */
interface Loaded {
    mesh: LoadedMesh;
    /** The layout or triangle mesh made from it. */
    surface: Handle;
    record: InputRecord;
    vertexCount: number;
}

/** What is told of layouts and targets alike. */
type MeshInfo = Omit<TargetInfo, "textureCoordinates">;

/** The last embedding, kept for export. */
interface Solved {
    job: Handle;
    options: JobOptions;
    layoutEdges: Uint32Array;
    landmarks: Uint32Array;
    inputs: InputRecord[];
    notes: string[];
}

export class Session implements EmbeddingSession {
    private layout: Loaded | null = null;
    private target: Loaded | null = null;
    private landmarks: (LandmarksInfo & { record: InputRecord }) | null = null;
    private solved: Solved | null = null;
    /** Of a landmark of the last embedding. */
    private drag: LandmarkDrag | null = null;
    /** An embedding kept in the core, and the last map from it. */
    private reference: Handle | null = null;
    private map: Handle | null = null;
    private disposed = false;
    private readonly isAlive = () => !this.disposed;

    private constructor(private readonly core: Core) {}

    /** A new session; loads the module first where that has not happened. */
    static async create(options: InitOptions = {}): Promise<Session> {
        return new Session(await Core.create(options));
    }

    async loadLayout(input: MeshInput, options: LoadOptions = {}): Promise<LayoutInfo> {
        const { core } = this;
        const [loaded, common] = await this.load("layout", input, options);
        const { offsets } = arraysOf(core, loaded.mesh.handle);
        const info = { ...common, offsets, edges: this.edgesOf(loaded) };
        this.forget(this.layout);
        this.layout = loaded;
        this.landmarks = null;
        // Maps are between embeddings of one layout.
        this.forgetReference();
        return info;
    }

    async loadTarget(input: MeshInput, options: TargetLoadOptions = {}): Promise<TargetInfo> {
        const [loaded, common] = await this.load("target", input, options);
        this.forget(this.target);
        this.target = loaded;
        this.landmarks = null;
        const isAsked = options.textureCoordinates === true;
        const textureCoordinates = isAsked
            ? textureCoordinatesOf(this.core, loaded.mesh.handle)
            : null;
        return { ...common, textureCoordinates };
    }

    async inspect(
        role: "layout" | "target",
        input: MeshInput,
        options: LoadOptions = {},
    ): Promise<UncheckedMesh> {
        this.assertAlive();
        const { handle } = readMesh(this.core, role, input, options);
        try {
            return Promise.resolve(arraysOf(this.core, handle));
        } finally {
            this.core.destroy(handle);
        }
    }

    async setLandmarks(
        input: LandmarkInput,
        options: LandmarkOptions = {},
    ): Promise<LandmarksInfo> {
        const notes: string[] = [];
        const record: InputRecord = { role: "landmarks", name: null, sha256: null };
        if ("bytes" in input) {
            record.name = input.name ?? null;
            record.sha256 = await sha256(byteArray(input.bytes, "the landmark file"));
        }
        let names: string[] = [];
        let landmarks = this.givenLandmarks(input, notes, names);
        const { layout, target } = this.inputs();
        if (options.numbering !== "loaded") {
            const ids = throughTargetRepair(landmarks, target);
            landmarks = Uint32Array.from(throughLayoutRepair(Array.from(ids), layout));
            names = throughLayoutRepair(names, layout);
        }
        this.confirm(layout, target, landmarks);
        this.landmarks = { landmarks, names, notes, record };
        return { landmarks: landmarks.slice(), names: [...names], notes: [...notes] };
    }

    async landmarksByProximity(): Promise<LandmarksInfo> {
        const { core } = this;
        const { layout, target } = this.inputs();
        const notes: string[] = [];
        const handle = core.call(
            "boundary_landmarks_by_proximity",
            layout.surface,
            layout.mesh.handle,
            target.surface,
        );
        const landmarks = this.takeLandmarks(handle, notes);
        this.confirm(layout, target, landmarks);
        const record: InputRecord = { role: "landmarks", name: null, sha256: null };
        this.landmarks = { landmarks, names: [], notes, record };
        return Promise.resolve({ landmarks: landmarks.slice(), names: [], notes: [...notes] });
    }

    async templateLayout(
        input: LandmarkInput,
        options: TemplateOptions = {},
    ): Promise<TemplateLayout> {
        const { core, target } = this;
        this.assertAlive();
        if (target === null) {
            throw javaScriptError("missingInput", "no target has been loaded");
        }
        const notes: string[] = [];
        const given = this.givenLandmarks(input, notes);
        const landmarks =
            options.numbering === "loaded" ? given : throughTargetRepair(given, target);
        const made = core.withCopies((copy) =>
            this.takeTemplate(
                core.call(
                    "boundary_template_create",
                    target.surface,
                    copy(landmarks),
                    landmarks.length,
                    options.quads === true ? 1 : 0,
                ),
            ),
        );
        return Promise.resolve({ ...made, landmarks, notes });
    }

    async solve(options: SolveOptions = {}): Promise<EmbedResult> {
        const { core } = this;
        const { layout, target } = this.inputs();
        const checked = jobOptions(options);
        if (this.landmarks === null) {
            await this.landmarksByProximity();
            this.assertAlive();
        }
        const landmarks = this.landmarks;
        if (landmarks === null) {
            throw javaScriptError("missingInput", "there are no landmarks");
        }
        const layoutEdges = this.edgesOf(layout);
        const job = createJob(core, layout.surface, target.surface, landmarks.landmarks, checked);
        const solved: Solved = {
            job,
            options: checked,
            layoutEdges,
            landmarks: landmarks.landmarks,
            inputs: [layout.record, target.record, landmarks.record],
            notes: [...layout.mesh.notes, ...target.mesh.notes, ...landmarks.notes],
        };
        try {
            await runJob(core, job, options, this.isAlive);
            const result = readResult(core, job, layoutEdges, solved.landmarks);
            this.endDrag();
            core.destroy(this.solved?.job ?? null);
            this.solved = solved;
            return result;
        } catch (reason) {
            core.destroy(job);
            throw reason;
        }
    }

    async reshape(shape: PathShape, options: ReshapeOptions = {}): Promise<EmbedResult> {
        const { core, solved } = this;
        this.assertAlive();
        // The shape is checked as solve() checks it.
        const checked = jobOptions({ ...solved?.options, shape });
        if (solved === null || !reshapeJob(core, solved.job, shape)) {
            throw javaScriptError("nothingToReshape", "no embedding was found in this session");
        }
        // Until it is done there is nothing to export.
        this.endDrag();
        this.solved = null;
        solved.options = checked;
        try {
            await runJob(core, solved.job, options, this.isAlive);
            const result = readResult(core, solved.job, solved.layoutEdges, solved.landmarks);
            core.destroy((this.solved as Solved | null)?.job ?? null);
            this.solved = solved;
            return result;
        } catch (reason) {
            core.destroy(solved.job);
            throw reason;
        }
    }

    async exportFiles(): Promise<ExportedFiles> {
        const exportable = this.exportable();
        const obj = refinedObj(this.core, this.embeddedJob());
        return Promise.resolve({ "refined.obj": obj, ...exportedFiles(exportable) });
    }

    async exportAs(
        formats: readonly ExportFormat[],
        view: ExportView = {},
    ): Promise<Record<string, Uint8Array>> {
        return Promise.resolve(exportJob(this.core, this.embeddedJob(), formats, view));
    }

    async quads(options: QuadOptions = {}): Promise<QuadMesh> {
        return makeQuads(this.core, this.embeddedJob(), options, this.isAlive);
    }

    async setReference(): Promise<void> {
        const reference = keepEmbedding(this.core, this.embeddedJob());
        this.forgetReference();
        this.reference = reference;
        return Promise.resolve();
    }

    async mapFromReference(options: SurfaceMapOptions = {}): Promise<SurfaceMap> {
        const { core, reference } = this;
        const job = this.embeddedJob();
        if (reference === null) {
            throw javaScriptError("noReference", "no embedding has been made the reference");
        }
        const map = await makeMap(core, reference, job, options, this.isAlive);
        core.destroy(this.map);
        this.map = map;
        return readMap(core, map);
    }

    async mapPoints(from: "reference" | "target", points: SurfacePoints): Promise<SurfacePoints> {
        this.assertAlive();
        if (this.map === null) {
            throw javaScriptError("noReference", "no map has been made");
        }
        return Promise.resolve(imagesOf(this.core, this.map, from, points));
    }

    async qualityReport(): Promise<QualityReport> {
        const job = this.embeddedJob();
        const edges = (this.solved?.layoutEdges.length ?? 0) / 2;
        return Promise.resolve(qualityReport(this.core, job, edges));
    }

    async candidatePaths(): Promise<CandidatePaths> {
        return Promise.resolve(candidatePaths(this.core, this.embeddedJob()));
    }

    async dragLandmark(layoutVertex: number, targetVertex: number): Promise<DraggedPaths | null> {
        const job = this.embeddedJob();
        if (this.drag?.landmark !== layoutVertex) {
            this.endDrag();
            this.drag = new LandmarkDrag(this.core, job, layoutVertex);
        }
        return Promise.resolve(this.drag.moveTo(targetVertex));
    }

    /** What embedding.json says of the last solve(), also where no embedding was found. */
    embeddingDocument(): EmbeddingDocument {
        return embeddingDocument(this.exportable());
    }

    async check(claim: EmbeddingClaim): Promise<Violation[]> {
        const { layout, target } = this.inputs();
        const { landmarks } = this;
        if (landmarks === null) {
            throw javaScriptError("missingInput", "there are no landmarks to check against");
        }
        return Promise.resolve(
            checkClaim(
                this.core,
                layout.mesh.handle,
                target.mesh.handle,
                landmarks.landmarks,
                claim,
            ),
        );
    }

    async dispose(): Promise<void> {
        if (!this.disposed) {
            this.disposed = true;
            this.endDrag();
            this.core.destroy(this.solved?.job ?? null);
            this.forgetReference();
            this.forget(this.layout);
            this.forget(this.target);
        }
        return Promise.resolve();
    }

    private endDrag(): void {
        this.drag?.end();
        this.drag = null;
    }

    /** The job of the last solve(), if it has an embedding. */
    private embeddedJob(): Handle {
        this.assertAlive();
        const { core, solved } = this;
        if (solved === null || !core.test("boundary_job_refined_positions", solved.job)) {
            throw javaScriptError("nothingToExport", "no embedding was found in this session");
        }
        return solved.job;
    }

    private exportable(): Exportable {
        this.assertAlive();
        const { core, solved } = this;
        if (solved === null) {
            throw javaScriptError("nothingToExport", "nothing has been solved in this session");
        }
        const { job, layoutEdges, landmarks, options, inputs, notes } = solved;
        // Read again, since the caller may have changed what solve() returned.
        const result = readResult(core, job, layoutEdges, landmarks);
        return { result, options, inputs, notes, version: core.version() };
    }

    /**
     * Reads, repairs and validates a mesh; leaves nothing behind if that fails or is aborted. Nothing
     * is awaited after the last look at the signal.
     */
    private async load(
        role: "layout" | "target",
        input: MeshInput,
        options: TargetLoadOptions,
    ): Promise<[Loaded, MeshInfo]> {
        this.assertAlive();
        const { core } = this;
        const record: InputRecord = { role, name: input.name ?? null, sha256: null };
        if ("bytes" in input) {
            record.sha256 = await sha256(byteArray(input.bytes, `the ${role}`));
            this.assertAlive();
        }
        const { signal } = options;
        await checkpoint(signal, this.isAlive);
        const { repair, attributes, textureCoordinates } = options;
        const isWanted = attributes === true || textureCoordinates === true;
        const mesh = readMesh(core, role, input, {
            ...(repair === undefined ? {} : { repair }),
            attributes: isWanted,
        });
        let surface: Handle | null = null;
        try {
            await checkpoint(signal, this.isAlive);
            surface = core.withCopies((copy) => {
                const subject = utf8(mesh.subject);
                return core.call(
                    `boundary_${role}_create`,
                    mesh.handle,
                    copy(subject),
                    subject.length,
                    ...(role === "target" ? [attributes === true ? 1 : 0] : []),
                );
            });
            if (attributes === true && !core.test("boundary_target_has_attributes", surface)) {
                mesh.notes.push(
                    `${mesh.subject}: Found no texture coordinates, colours, groups or materials.`,
                );
            }
            await checkpoint(signal, this.isAlive);
            const common = this.describe(role, surface, mesh, input.name ?? role);
            await checkpoint(signal, this.isAlive);
            const { vertexCount } = common;
            return [{ mesh, surface, record, vertexCount }, common];
        } catch (reason) {
            core.destroy(surface);
            core.destroy(mesh.handle);
            throw reason;
        }
    }

    private describe(
        role: "layout" | "target",
        surface: Handle,
        mesh: LoadedMesh,
        name: string,
    ): MeshInfo {
        const { positions, corners } = arraysOf(this.core, mesh.handle);
        this.core.call(`boundary_${role}_counts`, surface);
        const [vertexCount = 0, edgeCount = 0, faceCount = 0, boundaryLoopCount = 0] =
            this.core.viewedDoubles();
        return {
            name,
            vertexCount,
            edgeCount,
            faceCount,
            eulerCharacteristic: vertexCount - edgeCount + faceCount,
            boundaryLoopCount,
            vertexMap: mesh.vertexMap?.slice() ?? null,
            notes: [...mesh.notes],
            positions,
            corners,
        };
    }

    private edgesOf(layout: Loaded): Uint32Array {
        this.core.call("boundary_layout_edges", layout.surface);
        return this.core.viewedIds();
    }

    private givenLandmarks(
        input: LandmarkInput,
        notes: string[],
        names: string[] = [],
    ): Uint32Array<ArrayBuffer> {
        return "bytes" in input
            ? this.readLandmarks(
                  byteArray(input.bytes, "the landmark file"),
                  input.name,
                  notes,
                  names,
              )
            : landmarkIds(input);
    }

    private readLandmarks(
        bytes: Uint8Array,
        name: string | undefined,
        notes: string[],
        names: string[],
    ) {
        this.assertAlive();
        const { core } = this;
        const handle = core.withCopies((copy) => {
            const subject = utf8(`the landmark file${name === undefined ? "" : ` ${name}`}`);
            return core.call(
                "boundary_landmarks_read",
                copy(bytes),
                bytes.length,
                copy(subject),
                subject.length,
                // After a repair, ids in the file are not those of the mesh.
                this.target?.mesh.vertexMap === null ? this.target.mesh.handle : 0,
            );
        });
        return this.takeLandmarks(handle, notes, names);
    }

    private takeLandmarks(
        handle: Handle,
        notes: string[],
        names: string[] = [],
    ): Uint32Array<ArrayBuffer> {
        const { core } = this;
        try {
            for (let i = 0; core.test("boundary_landmarks_name", handle, i); ++i) {
                names.push(core.viewedText());
            }
            for (let i = 0; core.test("boundary_landmarks_note", handle, i); ++i) {
                notes.push(core.viewedText());
            }
            core.call("boundary_landmarks_ids", handle);
            return core.viewedIds();
        } finally {
            core.destroy(handle);
        }
    }

    /** The template layout that the last call made and shows the counts of. */
    private takeTemplate(mesh: Handle): Omit<TemplateLayout, "landmarks" | "notes"> {
        const { core } = this;
        const [collapses = 0, afterFlips = 0, inAnyShape = 0, flips = 0] = core.viewedDoubles();
        try {
            core.call("boundary_mesh_write_obj", mesh);
            const obj = core.viewedBytes();
            const removed = { collapses, afterFlips, inAnyShape };
            return { ...arraysOf(core, mesh), obj, removed, flips };
        } finally {
            core.destroy(mesh);
        }
    }

    /** Throws unless layout, target and landmarks fit together. */
    private confirm(layout: Loaded, target: Loaded, landmarks: Uint32Array): void {
        const { core } = this;
        core.withCopies((copy) =>
            core.call(
                "boundary_check_problem",
                layout.surface,
                target.surface,
                copy(landmarks),
                landmarks.length,
            ),
        );
    }

    private inputs(): { layout: Loaded; target: Loaded } {
        this.assertAlive();
        const { layout, target } = this;
        if (layout === null || target === null) {
            const missing = layout === null ? "layout" : "target";
            throw javaScriptError("missingInput", `no ${missing} has been loaded`);
        }
        return { layout, target };
    }

    private forget(loaded: Loaded | null): void {
        this.core.destroy(loaded?.surface ?? null);
        this.core.destroy(loaded?.mesh.handle ?? null);
    }

    private forgetReference(): void {
        this.core.destroy(this.map);
        this.core.destroy(this.reference);
        this.map = null;
        this.reference = null;
    }

    private assertAlive(): void {
        if (this.disposed) {
            throw javaScriptError("disposed", "the session cannot be used any more");
        }
    }
}

function landmarkIds(input: ArrayLike<number>): Uint32Array<ArrayBuffer> {
    return idArray(
        input,
        (place, value) =>
            new LayoutError(
                "landmarkOutOfRange",
                `landmark ${String(place)} is ${String(value)}; use 0-based vertex ids of the target.`,
                { landmark: place },
            ),
    );
}

/** Landmarks given for the target as it was before a repair, in the ids after it. */
function throughTargetRepair(given: Uint32Array, target: Loaded): Uint32Array<ArrayBuffer> {
    const targetMap = target.mesh.vertexMap;
    return Uint32Array.from(given, (vertex, place) => {
        const mapped = targetMap === null ? vertex : (targetMap[vertex] ?? vertex);
        if (mapped < 0) {
            throw new LayoutError(
                "landmarkOutOfRange",
                `landmark ${String(place)} is target vertex ${String(vertex)}, which the repair ` +
                    "removed; use a vertex that belongs to a face.",
                { landmark: place, vertex },
            );
        }
        return mapped;
    });
}

/**
 * What is given per vertex of a layout's file, per vertex of the layout that a repair made of it.
 */
function throughLayoutRepair<T>(given: readonly T[], layout: Loaded): T[] {
    const map = layout.mesh.vertexMap;
    // Whoever already left out the removed layout vertices is right, too.
    if (map?.length !== given.length || given.length === layout.vertexCount) {
        return [...given];
    }
    const kept: T[] = [];
    // Of welded vertices the first one counts.
    given.forEach((value, vertex) => {
        const mapped = map[vertex] ?? -1;
        if (mapped >= 0) {
            kept[mapped] ??= value;
        }
    });
    return kept;
}

function utf8(text: string): Uint8Array {
    return new TextEncoder().encode(text);
}

/** As hexadecimal digits; null where the platform offers no hashing (pages not served securely). */
async function sha256(bytes: Uint8Array<ArrayBuffer>): Promise<string | null> {
    const { crypto } = globalThis as { crypto?: { subtle?: SubtleCrypto } };
    if (crypto?.subtle === undefined) {
        return null;
    }
    const hash = new Uint8Array(await crypto.subtle.digest("SHA-256", bytes));
    return Array.from(hash, (byte) => byte.toString(16).padStart(2, "0")).join("");
}
