import type {
    EmbeddingSession,
    EmbedOptions,
    EmbedProblem,
    EmbedResult,
    LoadOptions,
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
