/** Does one thing after the other. Of what waits only the newest is done. */
export class Latest {
    private wish = 0;
    private waiting: ((isWanted: () => boolean) => Promise<void>) | null = null;
    private running = false;

    /** `task` is told whether nothing newer is wanted; it never rejects. */
    do(task: (isWanted: () => boolean) => Promise<void>): void {
        ++this.wish;
        this.waiting = task;
        if (!this.running) void this.run();
    }

    /** Nothing is wanted any more. */
    drop(): void {
        ++this.wish;
        this.waiting = null;
    }

    private async run(): Promise<void> {
        this.running = true;
        while (this.waiting) {
            const task = this.waiting;
            const wish = this.wish;
            this.waiting = null;
            await task(() => wish === this.wish);
        }
        this.running = false;
    }
}
