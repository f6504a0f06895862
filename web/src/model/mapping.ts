import type { EmbeddingSession, EmbedResult, SurfaceMap } from "layout-embedding";
import { loadShapes, type Shape } from "../gallery/catalogue.js";
import { isLandmarkFile } from "./batch.js";
import { Correspondence, otherSide, type FacePoint, type Side } from "./correspondence.js";
import { formatCount, formatLength, formatWhole, sentencesOf, statusWords } from "./describe.js";
import { bestOf, isStopped } from "./engine.js";
import { Latest } from "./latest.js";
import type { MapState, OtherTarget, Texture } from "./maps.js";
import type { SavedWork } from "./saved_work.js";
import { pathOptions } from "./solve_options.js";
import type { AppState } from "./state.js";
import type { Store } from "./store.js";
import type { Embedded, Workshop } from "./workshop.js";

/** Of both targets together: their overlay has several times as many, and is drawn twice. */
const mostTriangles = 500_000;

const optimisedWords = { no: "", partly: "partly optimised ", yes: "optimised " };

/**
 * Maps the target with its embedding onto a second target: at once as the patches give it, then
 * optimised. Whatever takes its time can be stopped: what has been made stays.
 */
export class Mapping {
    private readonly latest = new Latest();
    /** Ends the map that is being made. */
    private making = new AbortController();
    /** The session whose reference is the embedding of the first target. */
    private prepared: EmbeddingSession | null = null;
    /** The second target whose embedding it has. */
    private second: { session: EmbeddingSession; other: OtherTarget } | null = null;

    constructor(
        private readonly store: Store<AppState>,
        private readonly workshop: Workshop,
    ) {
        // A second target belongs to a layout.
        store.watch(
            (state) => [state.layout],
            () => {
                this.forgetMap();
                this.update({ other: null, target: null, landmarks: null, error: null });
            },
        );
        store.watch(
            (state) => [state.tab === "map", state.result],
            (shown, result) => {
                const { map } = store.get();
                if (map.of !== result && map.map) this.forgetMap();
                if (shown && result?.refined && map.other && map.of !== result) this.refresh();
                else if (!result) this.stop();
                // Nobody waits for it: its memory goes back.
                if (!shown && !result) this.workshop.close();
            },
        );
    }

    /** Maps onto another shape of the gallery's class. */
    chooseShape(shape: Shape): void {
        this.choose({
            title: shape.title,
            saved: { shape: shape.id },
            open: () => shape.open(),
        });
    }

    /** Maps onto a mesh with a landmark file, or without one: by proximity. */
    chooseFiles(files: readonly File[]): void {
        const mesh = files.find((file) => !isLandmarkFile(file));
        const landmarks = files.find(isLandmarkFile) ?? null;
        if (!mesh) {
            this.update({ error: "A second target is a mesh; landmarks alone are none." });
            return;
        }
        const contentOf = async (file: File) => ({
            name: file.name,
            bytes: await file.arrayBuffer(),
        });
        this.choose({
            title: mesh.name,
            saved: { files: landmarks ? [mesh, landmarks] : [mesh] },
            open: async () => ({
                target: await contentOf(mesh),
                landmarks: landmarks && (await contentOf(landmarks)),
            }),
        });
    }

    /** The second target of work that was put away, and what was shown of the map. */
    async restore({ second, map }: SavedWork): Promise<void> {
        const { texture, cursor } = map;
        if (second && "files" in second) this.chooseFiles(second.files);
        else if (second) {
            const shape = (await loadShapes()).find(({ id }) => id === second.shape);
            if (shape) this.chooseShape(shape);
        }
        // On both targets once there is a map.
        this.update({ texture, cursor: cursor && { ...cursor, a: null, b: null } });
    }

    setTexture(texture: Texture): void {
        this.update({ texture });
    }

    /** Ends what is going on; a map that was made stays, optimised as far as it is. */
    stop(): void {
        this.latest.drop();
        this.making.abort();
        this.workshop.interrupt();
        this.update({ phase: null, progress: null });
    }

    /** Makes the map again, after it was stopped. */
    again(): void {
        if (this.store.get().map.other) this.refresh();
    }

    /** Puts the cursor on a point of one target, and on its image. */
    pointAt(from: Side, point: FacePoint): void {
        const image = this.store.get().map.correspondence?.image(from, point) ?? null;
        this.setCursor(from, point, image, null);
    }

    /** Puts the cursor on a vertex of one target; said for those who do not see it. */
    pointAtVertex(from: Side, vertex: number): void {
        const { target, map } = this.store.get();
        const mesh = from === "a" ? target : map.target;
        const corner = mesh?.corners.indexOf(vertex) ?? -1;
        if (!mesh || corner < 0) {
            this.store.update({ announcement: `There is no vertex ${vertex}.` });
            return;
        }
        const weights = [0, 1, 2].map((k) => (k === corner % 3 ? 1 : 0));
        const image = map.correspondence?.imageOfVertex(from, vertex) ?? null;
        this.setCursor(
            from,
            { face: Math.floor(corner / 3), weights: weights as [number, number, number] },
            image,
            vertex,
        );
        this.store.update({
            announcement:
                `Vertex ${vertex} of the ${from === "a" ? "first" : "second"} target` +
                (image
                    ? ` corresponds to a point of triangle ${image.face}.`
                    : " has no counterpart."),
        });
    }

    private setCursor(
        from: Side,
        point: FacePoint,
        image: FacePoint | null,
        vertex: number | null,
    ): void {
        const at = { [from]: point, [otherSide(from)]: image } as Record<Side, FacePoint | null>;
        this.update({ cursor: { a: at.a, b: at.b, from, vertex } });
    }

    private choose(other: OtherTarget): void {
        this.forgetMap();
        this.update({ other, target: null, landmarks: null, error: null });
        this.refresh();
    }

    private refresh(): void {
        this.making.abort();
        this.latest.do((isWanted) => this.make(isWanted));
    }

    private async make(isWanted: () => boolean): Promise<void> {
        const { result, map, tab, options } = this.store.get();
        const { other } = map;
        if (!result?.refined || !other || tab !== "map") return;
        const making = new AbortController();
        this.making = making;
        const { signal } = making;
        this.update({ error: null, phase: "Taking over the embedding of the first target" });
        try {
            this.assertDrawable(0);
            await this.workshop.with(result, pathOptions(options), (embedded) =>
                this.makeOf(result, other, embedded, isWanted, signal),
            );
        } catch (error) {
            if (isWanted() && !isStopped(error)) this.update({ error: sentencesOf(error) });
        } finally {
            if (isWanted()) this.update({ phase: null, progress: null });
        }
    }

    private async makeOf(
        result: EmbedResult,
        other: OtherTarget,
        { session, textureCoordinates }: Embedded,
        isWanted: () => boolean,
        signal: AbortSignal,
    ): Promise<void> {
        const phase = (words: string, progress: number | null = null) => {
            if (isWanted()) this.update({ phase: words, progress });
        };
        if (this.prepared !== session) {
            await session.setReference();
            this.prepared = session;
        }
        const { second } = this;
        if (second?.session !== session || second.other !== other) {
            const first = await this.firstMap(session, other, isWanted, phase, signal);
            if (!first || !isWanted()) return;
            this.second = { session, other };
            this.update({ coordinates: textureCoordinates });
            this.show(first, result, "no");
        }
        const before = this.store.get().map.map;
        const optimising = "Optimising the map";
        phase(optimising);
        const optimised = await bestOf(
            session.mapFromReference({
                signal,
                onProgress: (progress) => phase(optimising, progress),
            }),
        );
        // What was stopped shows how far it came, unless something else is there by now.
        if (isWanted()) this.show(optimised, result, "yes");
        else if (this.store.get().map.map === before) this.show(optimised, result, "partly");
    }

    /** Throws where both targets, the second with so many triangles, are too large for a map. */
    private assertDrawable(faceCount: number): void {
        const size = faceCount + (this.store.get().target?.faceCount ?? 0);
        if (size > mostTriangles)
            throw new Error(
                `The targets have ${faceCount === 0 ? "more than " : ""}${formatCount(size, "triangle")} together, and a map here can ` +
                    `take ${formatWhole(mostTriangles)}; simplify one of them, or map with the package.`,
            );
    }

    /** The map as the patches give it; null where nobody wants it any more. */
    private async firstMap(
        session: EmbeddingSession,
        other: OtherTarget,
        isWanted: () => boolean,
        phase: (words: string, progress?: number | null) => void,
        signal: AbortSignal,
    ): Promise<SurfaceMap | null> {
        this.second = null;
        phase(`Reading ${other.title}`);
        const { target, landmarks } = await other.open();
        if (!isWanted()) return null;
        const { repair, options } = this.store.get();
        const info = await session.loadTarget(target, { repair, signal });
        this.assertDrawable(info.faceCount);
        const placed = await (landmarks
            ? session.setLandmarks(landmarks)
            : session.landmarksByProximity());
        if (!isWanted()) return null;
        this.update({ target: info, landmarks: placed.landmarks });
        const { gap, seed, workLimit } = options;
        const embedding = `Embedding the layout into ${other.title}`;
        phase(embedding);
        const { refined, status } = await session.solve({
            ...pathOptions(options),
            gap,
            seed,
            ...(workLimit !== null && { workLimit }),
            doubts: false,
            signal,
            onProgress: ({ phase: part, progress }) =>
                phase(embedding, part === "search" ? progress : null),
        });
        if (!isWanted()) return null;
        if (!refined)
            throw new Error(
                `${statusWords[status]} of the layout in ${other.title}; ` +
                    "check its landmarks, or choose another target.",
            );
        phase("Mapping patch onto patch");
        return session.mapFromReference({ rounds: 0, seamPasses: 0, signal });
    }

    private show(map: SurfaceMap, of: EmbedResult, optimised: MapState["optimised"]): void {
        const correspondence = new Correspondence(map);
        this.update({ map, correspondence, of, optimised });
        const { cursor } = this.store.get().map;
        if (cursor?.vertex !== null && cursor?.vertex !== undefined)
            this.pointAtVertex(cursor.from, cursor.vertex);
        else {
            const point = cursor?.[cursor.from];
            if (cursor && point) this.pointAt(cursor.from, point);
        }
        const { meanEnergy } = map.distortion;
        this.store.update({
            announcement:
                `The ${optimisedWords[optimised]}map is there. ` +
                `Its mean energy is ${formatLength(meanEnergy)}.`,
        });
    }

    private forgetMap(): void {
        this.update({
            map: null,
            correspondence: null,
            of: null,
            optimised: "no",
            cursor: null,
        });
    }

    private update(change: Partial<MapState>): void {
        this.store.update({ map: { ...this.store.get().map, ...change } });
    }
}
