/** Steps back and forth between values. */
export class History<Value> {
    private readonly past: Value[] = [];
    private readonly future: Value[] = [];

    /** More steps than anyone takes back by hand. */
    private static readonly limit = 500;

    /** Remembers the value before a change. */
    record(before: Value): void {
        this.past.push(before);
        if (this.past.length > History.limit) this.past.shift();
        this.future.length = 0;
    }

    /** The value before the last change, given the one now; null if there is none. */
    back(now: Value): Value | null {
        const value = this.past.pop();
        if (value === undefined) return null;
        this.future.push(now);
        return value;
    }

    forth(now: Value): Value | null {
        const value = this.future.pop();
        if (value === undefined) return null;
        this.past.push(now);
        return value;
    }

    clear(): void {
        this.past.length = this.future.length = 0;
    }

    get canGoBack(): boolean {
        return this.past.length > 0;
    }

    get canGoForth(): boolean {
        return this.future.length > 0;
    }
}
