import { createWorkerClient } from "layout-embedding/worker";
import type { Worker } from "./model/engine.js";

/** The package in a worker of its own. */
export async function startWorker(): Promise<Worker> {
    const worker = await createWorkerClient();
    return {
        createSession: () => worker.createSession(),
        terminate: () => worker.terminate(),
    };
}
