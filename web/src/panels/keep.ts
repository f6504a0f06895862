import type { Actions, SavedWork } from "../model/actions.js";
import { unpackSession } from "../model/session_file.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";

const databaseName = "layout-embedding";
const shelf = "work";
const slot = "last";
/** Milliseconds without a change after which the work is put away. */
const calm = 800;

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
    let timer: ReturnType<typeof setTimeout> | undefined;
    const put = () => {
        // Examples and shapes that nobody changed are not worth keeping.
        const { origin, undoable } = store.get();
        const work = origin && !undoable ? null : actions.saved();
        withShelf("readwrite", (shelves) => shelves.put(work, slot)).catch(() => undefined);
    };
    return {
        async openFiles(files) {
            const session = files.find((file) => /\.zip$/i.test(file.name));
            if (!session) return actions.openFiles(files);
            try {
                const bytes = new Uint8Array(await session.arrayBuffer());
                await actions.restore(unpackSession(session.name, bytes));
            } catch (error) {
                actions.report(error);
            }
        },
        async restore() {
            const work = await withShelf<SavedWork | null>("readonly", (shelves) =>
                shelves.get(slot),
            ).catch(() => null);
            if (!work?.target) return false;
            await actions.restore(work);
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
                ],
                () => {
                    clearTimeout(timer);
                    timer = setTimeout(put, calm);
                },
            );
        },
    };
}

/** Does one thing with the browser's database; rejected where the page may not have one. */
function withShelf<Result>(
    mode: IDBTransactionMode,
    act: (shelves: IDBObjectStore) => IDBRequest,
): Promise<Result> {
    return new Promise((resolve, reject) => {
        const opening = indexedDB.open(databaseName, 1);
        const fail = () => reject(new Error("the browser keeps nothing for this page"));
        opening.onupgradeneeded = () => opening.result.createObjectStore(shelf);
        opening.onerror = opening.onblocked = fail;
        opening.onsuccess = () => {
            const database = opening.result;
            const transaction = database.transaction(shelf, mode);
            const request = act(transaction.objectStore(shelf));
            transaction.oncomplete = () => {
                database.close();
                resolve(request.result as Result);
            };
            transaction.onabort = transaction.onerror = fail;
        };
    });
}
