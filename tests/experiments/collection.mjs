// Figs. 10 and 11: the template of one member of each class in the others.
import { algorithms, heuristics, tolerance, worstExcess } from "./methods.mjs";
import { embeddingPicture, viewOfEdges } from "./drawing/picture.mjs";
import { generatedShapes, readMember, shippedShapes } from "./problems.mjs";
import { openSession, solveAndRecord } from "./solving.mjs";

export { claims, section } from "./collection_report.mjs";

export const title = "A layout per class of shapes (Figs. 10 and 11)";

/** Native programs that it runs. */
export const tools = (quick) => (quick ? [] : ["generate_shapes"]);

export async function run({ pool, quick }) {
    const classes = quick ? shippedShapes() : await generatedShapes();
    const limit = quick ? 4_000_000 : 12_000_000;
    const inputs = classes.flatMap(({ name, title: shown, genus, boundaryLoops, members }) =>
        members.slice(1).map((target) => ({
            name,
            shown,
            genus,
            boundaryLoops,
            source: members[0],
            target,
            limit,
        })),
    );
    const instances = await pool.all("collection", "solve", inputs);
    // The worst heuristic of each class, the classes with the worst ones first.
    const worst = new Map();
    instances.forEach((instance, i) => {
        const excess = worstExcess(instance);
        if (excess > (worst.get(instance.name)?.excess ?? 1.03)) {
            worst.set(instance.name, { excess, input: inputs[i] });
        }
    });
    const chosen = [...worst.values()].sort((a, b) => b.excess - a.excess).slice(0, quick ? 2 : 8);
    const drawn = await pool.all(
        "collection",
        "draw",
        chosen.map(({ input }) => input),
    );
    return { limit, instances, drawn };
}

export const tasks = {
    async solve({ name, shown, genus, boundaryLoops, source, target, limit }) {
        const session = await openSession({ template: readMember(source), ...readMember(target) });
        const records = {};
        let layoutEdges = 0;
        for (const algorithm of algorithms) {
            const { record, result } = await solveAndRecord(session, {
                algorithm,
                gap: algorithm === "exact" ? 0 : tolerance,
                ...(heuristics.includes(algorithm) ? {} : { workLimit: limit }),
            });
            records[algorithm] = record;
            layoutEdges = Math.max(layoutEdges, result.edges.length);
        }
        return {
            name,
            shown,
            genus,
            boundaryLoops,
            source: source.name,
            target: target.name,
            vertices: target.vertices,
            layoutEdges,
            records,
        };
    },

    /** Pictures of the heuristics' embeddings and the best one; what detours is red. */
    async draw({ name, shown, source, target, limit }) {
        const session = await openSession({ template: readMember(source), ...readMember(target) });
        const results = {};
        for (const algorithm of [...heuristics, "exact"]) {
            const options = { algorithm, gap: 0, workLimit: limit };
            const { result } = await solveAndRecord(session, options);
            results[algorithm] = result;
        }
        const best = results.exact;
        const detours = (result) =>
            result.edges
                .filter(({ id, cost }) => cost > 1.25 * best.edges[id].cost)
                .map(({ id }) => id);
        const worst = heuristics
            .map((algorithm) => results[algorithm])
            .filter(({ refined }) => refined !== null)
            .reduce((a, b) => (b.cost > a.cost ? b : a));
        const shownEdges = detours(worst);
        const view = viewOfEdges(worst, shownEdges);
        const drawings = [...heuristics, "exact"].map((algorithm) => {
            const result = results[algorithm];
            const highlight = algorithm === "exact" ? shownEdges : detours(result);
            const label = `${name}-${target.name}-${algorithm}`;
            return {
                algorithm,
                ratio: result.refined === null ? null : result.cost / best.cost,
                detours: result.refined === null ? 0 : detours(result).length,
                picture:
                    result.refined === null
                        ? null
                        : embeddingPicture(label, result, { view, highlight }),
            };
        });
        return { shown, source: source.name, target: target.name, drawings };
    },
};
