// Tasks of experiments in processes of their own, a few at a time, so that CPU seconds and memory are
// those of one task.
import { fork } from "node:child_process";
import path from "node:path";

export class Pool {
    /** CPU seconds of all tasks so far, and embeddings made by them. */
    cpuSeconds = 0;
    embeddings = 0;
    finished = 0;

    /** `folder`: where tasks put their pictures. */
    constructor(size, folder) {
        this.size = size;
        this.folder = folder;
        this.waiting = [];
        this.running = 0;
    }

    /**
     * Calls `tasks[task](input)` of an experiment's file. Resolves to what it returns, with
     * `cpuSeconds` and `peakMegabytes` of its process.
     */
    run(experiment, task, input) {
        return new Promise((resolve, reject) => {
            this.waiting.push({ job: { experiment, task, input }, resolve, reject });
            this.startNext();
        });
    }

    /** The same for many inputs, in their order. */
    all(experiment, task, inputs) {
        return Promise.all(inputs.map((input) => this.run(experiment, task, input)));
    }

    startNext() {
        if (this.running === this.size || this.waiting.length === 0) {
            return;
        }
        const { job, resolve, reject } = this.waiting.shift();
        ++this.running;
        const child = fork(path.join(import.meta.dirname, "worker.mjs"), {
            serialization: "advanced",
            stdio: ["ignore", "inherit", "inherit", "ipc"],
        });
        let answer;
        child.on("message", (message) => (answer = message));
        child.on("error", reject);
        child.on("exit", (code, signal) => {
            --this.running;
            if (answer === undefined) {
                const how = signal ?? `code ${code}`;
                reject(new Error(`${job.experiment}, ${job.task} ended with ${how}`));
            } else {
                this.cpuSeconds += answer.cpuSeconds;
                this.embeddings += answer.embeddings;
                ++this.finished;
                resolve(answer.result);
            }
            this.startNext();
        });
        child.send({ ...job, folder: this.folder });
    }
}
