import type { EmbeddingSession, EmbedResult, SurfaceMap } from "layout-embedding";
import { loadShapes, type Shape } from "../gallery/catalogue.js";
import { isLandmarkFile } from "./batch.js";
import { Correspondence, otherSide, type FacePoint, type Side } from "./correspondence.js";
import { formatLength, sentencesOf, statusWords } from "./describe.js";
import { Latest } from "./latest.js";
import type { MapState, OtherTarget, Texture } from "./maps.js";
import type { SavedSecond } from "./sources.js";
import type { AppState } from "./state.js";
import type { Store } from "./store.js";
import { isStopped, type Workshop } from "./workshop.js";

/**
 * Maps the target with its embedding onto a second target: at once as the patches give it, then
 * optimised. Whatever takes its time can be stopped: what has been made stays.
 */
export class Mapping {
    private readonly latest = new Latest();
    private busy = false;
    /** The session whose reference is the embedding of the first target. */
    private prepared: EmbeddingSession | null = null;

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
                if (!shown && !result) this.workshop.stop();
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

    /** The second target of work that was put away. */
    async restore(saved: SavedSecond): Promise<void> {
        if ("files" in saved) return this.chooseFiles(saved.files);
        const shape = (await loadShapes()).find(({ id }) => id === saved.shape);
        if (shape) this.chooseShape(shape);
    }

    setTexture(texture: Texture): void {
        this.update({ texture });
    }

    /** Ends what is going on; a map that was made stays. */
    stop(): void {
        this.latest.drop();
        this.interrupt();
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
        this.interrupt();
        this.latest.do((isWanted) => this.make(isWanted));
    }

    /** Nothing in the worker can be ended but with the worker. */
    private interrupt(): void {
        if (this.busy) this.workshop.stop();
    }

    private async make(isWanted: () => boolean): Promise<void> {
        const { result, map, tab } = this.store.get();
        if (!result?.refined || !map.other || tab !== "map") return;
        this.busy = true;
        this.update({ error: null });
        try {
            await this.makeOf(result, map.other, isWanted);
        } catch (error) {
            if (isWanted() && !isStopped(error)) this.update({ error: sentencesOf(error) });
        } finally {
            this.busy = false;
            if (isWanted()) this.update({ phase: null, progress: null });
        }
    }

    private async makeOf(
        result: EmbedResult,
        other: OtherTarget,
        isWanted: () => boolean,
    ): Promise<void> {
        const phase = (words: string, progress: number | null = null) => {
            if (isWanted()) this.update({ phase: words, progress });
        };
        phase(`Reading ${other.title}`);
        const { target, landmarks } = await other.open();
        phase("Taking over the embedding of the first target");
        const session = await this.referenced(result);
        if (!isWanted()) return;
        phase(`Reading ${other.title}`);
        const info = await session.loadTarget(target, { repair: this.store.get().repair });
        const placed = await (landmarks
            ? session.setLandmarks(landmarks)
            : session.landmarksByProximity());
        if (!isWanted()) return;
        this.update({ target: info, landmarks: placed.landmarks });
        const { gap, seed, workLimit } = this.store.get().options;
        const embedding = `Embedding the layout into ${other.title}`;
        phase(embedding);
        const { refined, status } = await session.solve({
            gap,
            seed,
            ...(workLimit !== null && { workLimit }),
            onProgress: ({ phase: part, progress }) =>
                phase(embedding, part === "search" ? progress : null),
        });
        if (!refined)
            throw new Error(
                `${statusWords[status]} of the layout in ${other.title}; ` +
                    "check its landmarks, or choose another target.",
            );
        phase("Mapping patch onto patch");
        const first = await session.mapFromReference({ rounds: 0, seamPasses: 0 });
        if (!isWanted()) return;
        this.show(first, result, false);
        phase("Optimising the map");
        const optimised = await session.mapFromReference();
        if (isWanted()) this.show(optimised, result, true);
    }

    /** A session whose reference is the embedding of the first target. */
    private async referenced(result: EmbedResult): Promise<EmbeddingSession> {
        const session = await this.workshop.embedded(result);
        if (this.prepared !== session) {
            await session.setReference();
            this.prepared = session;
        }
        return session;
    }

    private show(map: SurfaceMap, of: EmbedResult, isOptimised: boolean): void {
        const correspondence = new Correspondence(map);
        this.update({ map, correspondence, of, isOptimised });
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
                `The ${isOptimised ? "optimised " : ""}map is there. ` +
                `Its mean energy is ${formatLength(meanEnergy)}.`,
        });
    }

    private forgetMap(): void {
        this.update({
            map: null,
            correspondence: null,
            of: null,
            isOptimised: false,
            cursor: null,
        });
    }

    private update(change: Partial<MapState>): void {
        this.store.update({ map: { ...this.store.get().map, ...change } });
    }
}
