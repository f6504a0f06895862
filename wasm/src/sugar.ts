import { javaScriptError } from "./errors.js";
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
    const { repair, ...solveOptions } = options;
    const load = { repair: repair === true };
    await session.loadLayout(problem.layout, load);
    await session.loadTarget(problem.target, load);
    if (problem.landmarks !== undefined) {
        await session.setLandmarks(problem.landmarks);
    }
    return session.solve(solveOptions);
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
    const { repair, rounds, seamPasses, ...solveOptions } = options;
    const load = { repair: repair === true };
    await session.loadLayout(problem.layout, load);
    for (const role of ["reference", "target"] as const) {
        const { target, landmarks } = problem[role];
        await session.loadTarget(target, load);
        if (landmarks !== undefined) {
            await session.setLandmarks(landmarks);
        }
        const { refined, status } = await session.solve(solveOptions);
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
    return session.mapFromReference({
        ...(rounds !== undefined && { rounds }),
        ...(seamPasses !== undefined && { seamPasses }),
    });
}

/** One template layout in a fresh session of either kind. */
export async function templateIn(
    session: EmbeddingSession,
    problem: TemplateProblem,
    options: TemplateOptions & LoadOptions,
): Promise<TemplateLayout> {
    const { repair, ...templateOptions } = options;
    const target = await session.loadTarget(problem.target, { repair: repair === true });
    const layout = await session.templateLayout(problem.landmarks, templateOptions);
    return { ...layout, notes: [...target.notes, ...layout.notes] };
}
