import { CancelledError, javaScriptError } from "./errors.js";
import type {
    EmbeddingSession,
    EmbedOptions,
    EmbedProblem,
    EmbedResult,
    LoadOptions,
    SurfaceMap,
    SurfaceMapOptions,
    SurfaceMapProblem,
    TemplateLayout,
    TemplateOptions,
    TemplateProblem,
} from "./types.js";

/** One embedding from beginning to end in a fresh session of either kind. */
export async function embedIn(
    session: EmbeddingSession,
    problem: EmbedProblem,
    options: EmbedOptions,
): Promise<EmbedResult> {
    const [load, solveOptions] = separated(options);
    await session.loadLayout(problem.layout, load);
    await session.loadTarget(problem.target, load);
    if (problem.landmarks !== undefined) {
        await session.setLandmarks(problem.landmarks);
    }
    return finished(session.solve(solveOptions));
}

/**
 * One map from beginning to end in a fresh session of either kind. Rejects with noEmbedding where
 * the layout was not embedded in both targets.
 */
export async function mapIn(
    session: EmbeddingSession,
    problem: SurfaceMapProblem,
    options: EmbedOptions & SurfaceMapOptions,
): Promise<SurfaceMap> {
    const [load, { rounds, seamPasses, ...solveOptions }] = separated(options);
    await session.loadLayout(problem.layout, load);
    for (const role of ["reference", "target"] as const) {
        const { target, landmarks } = problem[role];
        await session.loadTarget(target, load);
        if (landmarks !== undefined) {
            await session.setLandmarks(landmarks);
        }
        const { refined, status } = await finished(session.solve(solveOptions));
        if (refined === null) {
            throw javaScriptError(
                "noEmbedding",
                `the layout was not embedded in the ${role} (${status})`,
            );
        }
        if (role === "reference") {
            await session.setReference();
        }
    }
    const { signal } = options;
    const map = session.mapFromReference({
        ...(signal && { signal }),
        ...(rounds !== undefined && { rounds }),
        ...(seamPasses !== undefined && { seamPasses }),
    });
    return finished(map);
}

/** One template layout in a fresh session of either kind. */
export async function templateIn(
    session: EmbeddingSession,
    problem: TemplateProblem,
    options: TemplateOptions & LoadOptions,
): Promise<TemplateLayout> {
    const [load, templateOptions] = separated(options);
    const target = await session.loadTarget(problem.target, load);
    const layout = await session.templateLayout(problem.landmarks, templateOptions);
    return { ...layout, notes: [...target.notes, ...layout.notes] };
}

/** What of the options is for loads, and all but that; the signal is for both. */
function separated<Options extends LoadOptions>({ repair, ...others }: Options) {
    const { signal } = others;
    const load: LoadOptions = { repair: repair === true, ...(signal && { signal }) };
    return [load, others] as const;
}

/** The session ends with the call, so that nobody could wait for what is late but here. */
async function finished<Value>(call: Promise<Value>): Promise<Value> {
    try {
        return await call;
    } catch (reason) {
        if (reason instanceof CancelledError) {
            return (await reason.late) as Value;
        }
        throw reason;
    }
}
