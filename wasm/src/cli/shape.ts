/** A value of unknown JSON and where it stands, taken apart step by step. */
export class Shape {
    constructor(
        private readonly value: unknown,
        private readonly place: string,
        /** Makes the error of a value that has not the right shape. */
        private readonly refuse: (what: string) => Error,
    ) {}

    get(key: string): Shape {
        if (typeof this.value !== "object" || this.value === null || Array.isArray(this.value)) {
            throw this.wrong("an object");
        }
        const value = (this.value as Record<string, unknown>)[key];
        return new Shape(value, `${this.place}: ${key}`, this.refuse);
    }

    list<T>(item: (shape: Shape) => T): T[] {
        return this.listOf(0, Infinity, item);
    }

    /** A list of at least `least` and at most `most` items. */
    listOf<T>(least: number, most: number, item: (shape: Shape) => T): T[] {
        if (!Array.isArray(this.value) || this.value.length < least || this.value.length > most) {
            throw this.wrong("a list of the right length");
        }
        return this.value.map((value: unknown, i) =>
            item(new Shape(value, `${this.place}[${String(i)}]`, this.refuse)),
        );
    }

    tuple<T>(length: number, item: (shape: Shape) => T): T[] {
        return this.listOf(length, length, item);
    }

    nullOr<T>(item: () => T): T | null {
        return this.value === null ? null : item();
    }

    number(): number {
        if (typeof this.value !== "number") {
            throw this.wrong("a number");
        }
        return this.value;
    }

    /** A 0-based id. */
    id(): number {
        const id = this.number();
        if (!Number.isInteger(id) || id < 0 || id >= 0xffff_ffff) {
            throw this.wrong("an id");
        }
        return id;
    }

    text(): string {
        if (typeof this.value !== "string") {
            throw this.wrong("a text");
        }
        return this.value;
    }

    exactly<T>(wanted: T): T {
        if (this.value !== wanted) {
            throw this.wrong(String(wanted));
        }
        return wanted;
    }

    private wrong(wanted: string): Error {
        return this.refuse(`${this.place} is not ${wanted}`);
    }
}
