/** A value with listeners: the one place the page's state lives. */
export interface Store<State extends object> {
    get(): Readonly<State>;
    /** Replaces some fields and tells the listeners, once per call. */
    update(change: Partial<State>): void;
    /**
     * Calls `listener` now and whenever one of the fields `select` returns has changed (compared by
     * identity). Views use this to redraw only what concerns them.
     */
    watch<Fields extends unknown[]>(
        select: (state: Readonly<State>) => readonly [...Fields],
        listener: (...fields: NoInfer<Fields>) => void,
    ): void;
}

export function createStore<State extends object>(initial: State): Store<State> {
    let state: Readonly<State> = initial;
    const listeners: (() => void)[] = [];
    return {
        get: () => state,
        update(change) {
            state = { ...state, ...change };
            for (const notify of listeners) notify();
        },
        watch(select, listener) {
            let seen = select(state);
            listener(...seen);
            listeners.push(() => {
                const now = select(state);
                if (now.every((field, i) => Object.is(field, seen[i]))) return;
                seen = now;
                listener(...now);
            });
        },
    };
}
