import type { Actions } from "../model/actions.js";
import { checkedRest, partsReader, type SavedMeshes, type SavedRest } from "../model/saved_work.js";
import { unpackSession } from "../model/session_file.js";
import type { AppState, Origin } from "../model/state.js";
import type { Store } from "../model/store.js";

const databaseName = "layout-embedding";
const shelf = "work";
/** The meshes are large and change seldom: a record of their own. */
const meshSlot = "meshes";
const slot = "last";
/** Milliseconds without a change after which the work is put away. */
const calm = 500;

/** Session files, and the copy of the last work in this browser. */
export interface Keep {
    /** Files from a drop or the file dialog; a session among them brings everything back. */
    openFiles(files: readonly File[]): Promise<void>;
    /** Brings back the work of the last visit; false if there is none. */
    restore(): Promise<boolean>;
    /** From now on every change is put away. */
    start(): void;
}

export function keepWork(store: Store<AppState>, actions: Actions): Keep {
    const shelves = new Shelves();
    let timer: ReturnType<typeof setTimeout> | undefined;
    let kept: SavedMeshes | null = null;
    /** Where work that was put away came from: it was changed, whatever undo can tell. */
    let restored: Origin | null = null;
    /** Examples and shapes that nobody changed are not worth keeping. */
    const isWorth = ({ origin, undoable, map, quadMesh }: AppState) =>
        !origin ||
        origin === restored ||
        undoable ||
        map.other !== null ||
        quadMesh.edgeLength !== null ||
        quadMesh.segments.length > 0;
    const put = () => {
        clearTimeout(timer);
        timer = undefined;
        if (!isWorth(store.get())) {
            kept = null;
            shelves.put({ [slot]: null, [meshSlot]: null });
            return;
        }
        const { layout, target, second, ...rest } = actions.saved();
        const known = kept?.layout === layout && kept.target === target && kept.second === second;
        kept = { layout, target, second };
        shelves.put({ [slot]: rest, ...(known ? {} : { [meshSlot]: kept }) });
    };
    return {
        async openFiles(files) {
            const session = files.find((file) => /\.zip$/i.test(file.name));
            if (!session) return actions.openFiles(files);
            try {
                const bytes = new Uint8Array(await session.arrayBuffer());
                const { work, lost } = unpackSession(session.name, bytes);
                await actions.restore(work);
                restored = store.get().origin;
                if (lost.length > 0)
                    actions.notice(`${session.name} is damaged; lost are ${lost.join(", ")}.`);
            } catch (error) {
                actions.report(error);
            }
        },
        async restore() {
            const [rest, meshes] = await Promise.all([
                shelves.get<Partial<SavedRest>>(slot),
                shelves.get<Partial<SavedMeshes>>(meshSlot),
            ]);
            if (!rest || !meshes?.target) return false;
            // An earlier version of the page put less away.
            const { target, layout = null, second = null } = meshes;
            const known = checkedRest(rest, partsReader([]));
            await actions.restore({ ...known, target, layout, second });
            restored = store.get().origin;
            actions.notice("This is what was open at your last visit. The gallery has examples.");
            return store.get().target !== null;
        },
        start() {
            store.watch(
                (state) => [
                    state.layout,
                    state.target,
                    state.landmarks,
                    state.options,
                    state.making,
                    state.routes,
                    state.map.other,
                    state.map.texture,
                    state.map.cursor?.vertex,
                    state.quadMesh.edgeLength,
                    state.quadMesh.segments,
                    state.tab,
                    state.result !== null,
                ],
                () => {
                    clearTimeout(timer);
                    timer = setTimeout(put, calm);
                },
            );
            // Whoever leaves right after an edit finds it again, too.
            const flush = () => {
                if (timer !== undefined) put();
            };
            addEventListener("pagehide", flush);
            document.addEventListener("visibilitychange", () => {
                if (document.visibilityState === "hidden") flush();
            });
        },
    };
}

/** The browser's database. Where the page may not have one, nothing is kept and nothing is found. */
class Shelves {
    /** Open all the time: a page that is being left has no time to open anything. */
    private database: IDBDatabase | null = null;
    private readonly opened: Promise<void>;

    constructor() {
        this.opened = new Promise((resolve) => {
            const over = () => resolve();
            try {
                const opening = indexedDB.open(databaseName, 1);
                opening.onupgradeneeded = () => opening.result.createObjectStore(shelf);
                opening.onerror = opening.onblocked = over;
                opening.onsuccess = () => {
                    this.database = opening.result;
                    this.database.onversionchange = () => this.database?.close();
                    over();
                };
            } catch {
                over();
            }
        });
    }

    /** Null where there is nothing. */
    async get<Value>(name: string): Promise<Value | null> {
        await this.opened;
        return new Promise((resolve) => {
            try {
                const request = this.database?.transaction(shelf).objectStore(shelf).get(name);
                if (!request) return resolve(null);
                request.onsuccess = () => resolve((request.result as Value | undefined) ?? null);
                request.onerror = () => resolve(null);
            } catch {
                resolve(null);
            }
        });
    }

    /** Puts some values away, all or none. */
    put(values: Readonly<Record<string, unknown>>): void {
        try {
            const transaction = this.database?.transaction(shelf, "readwrite");
            if (!transaction) return;
            for (const [name, value] of Object.entries(values))
                transaction.objectStore(shelf).put(value, name);
            // Not left to the end of this turn, which a page that is being left may not see.
            transaction.commit();
        } catch {
            // A full disk, a private window: the work is open all the same.
        }
    }
}
