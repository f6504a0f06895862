// Embeddings through the package, as records of plain numbers.
import { threadSeconds } from "../bench/process.mjs";
// After process.mjs, which watches the module's memory.
import { Session } from "layout-embedding";

let embeddings = 0;

/** Embeddings that this process has made; each was confirmed by the checker inside solve(). */
export function embeddingCount() {
    return embeddings;
}

/**
 * A session with the problem { layout, target, landmarks }, or { template: { target, landmarks },
 * target, landmarks }, whose layout is made of the template; `quads` asks for one in quads.
 */
export async function openSession(problem) {
    const session = await Session.create();
    await loadProblem(session, problem);
    return session;
}

export async function loadProblem(session, { layout, template, quads, target, landmarks }) {
    let coarse = layout;
    if (template !== undefined) {
        await session.loadTarget(template.target);
        coarse = await session.templateLayout(template.landmarks, { quads: quads === true });
    }
    const layoutInfo = await session.loadLayout(coarse);
    const targetInfo = await session.loadTarget(target);
    await session.setLandmarks(landmarks);
    return { layoutInfo, targetInfo };
}

/**
 * Solves and returns { result, record }: the package's result, and what is kept of it. CPU seconds
 * of events are their seconds by the clock times the share of the processor that the solve had.
 */
export async function solveAndRecord(session, options) {
    const began = threadSeconds();
    const result = await session.solve(options);
    const cpu = threadSeconds() - began;
    const last = result.events.at(-1)?.seconds ?? 0;
    const share = last > 0 ? Math.min(1, cpu / last) : 1;
    const searched = result.events.find(
        ({ kind, phase }) => kind === "phase" && ["realise", "check", "done"].includes(phase),
    );
    const incumbents = result.events.filter(({ kind }) => kind === "incumbent");
    if (result.refined !== null) {
        ++embeddings;
    }
    const record = {
        algorithm: options.algorithm ?? "exact",
        status: result.status,
        cost: finite(result.cost),
        lowerBound: result.lowerBound,
        gap: result.gap,
        boundScope: result.boundScope,
        cpuTotal: cpu,
        cpuSearch: (searched?.seconds ?? last) * share,
        cpuBest: incumbents.length > 0 ? incumbents.at(-1).seconds * share : null,
        work: result.counters.work,
        counters: result.counters,
        history: result.events
            .filter(({ kind }) => kind === "incumbent" || kind === "bound")
            .map((event) => ({
                cpu: event.seconds * share,
                work: event.work,
                cost: finite(event.cost),
                lowerBound: event.lowerBound,
            })),
    };
    return { result, record };
}

/** A record without its history, where only the end matters. */
export function withoutHistory(record) {
    const { history, ...rest } = record;
    return { ...rest, events: history.length };
}

const finite = (number) => (Number.isFinite(number) ? number : null);
