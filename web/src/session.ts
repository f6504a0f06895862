import { createWorkerClient } from "layout-embedding/worker";
import type { WorkerSession } from "./model/engine.js";

/** A session of the package in a worker of its own. */
export async function createSession(): Promise<WorkerSession> {
    const worker = await createWorkerClient();
    const session = await worker.createSession();
    return { session, terminate: () => worker.terminate() };
}
