// The inset of Sec. 6: where no insertion sequence is optimal, on general graphs and on layouts.
import { keptPaths } from "./paths.mjs";
import { pinwheel } from "./pinwheel.mjs";
import { prism, problemOf, sphereProblemAt } from "./problems.mjs";
import { problemFiles, runTool } from "./native.mjs";
import { cross, normalized } from "../bench/vectors.mjs";
import { embeddingPicture } from "./drawing/picture.mjs";
import { claimsOf, judge } from "./report/claims.mjs";
import { findings, integer, number, percent, picture, pictures, table } from "./report/html.mjs";
import { openSession, solveAndRecord } from "./solving.mjs";

export const title = "Where no insertion sequence is optimal (inset of Sec. 6)";

/** Native programs that it runs. */
export const tools = () => ["search_variants", "insertion_orders"];

/** Directions of a prism's landmarks, found by a random search. */
const directions = [
    [-0.484441642, 0.864929336, 0.131200379],
    [-0.70290703, 0.711281735, 0],
    [-0.75793542, -0.468429851, -0.4539905],
    [-0.864929336, 0.131200379, -0.484441642],
    [-0.08232358, -0.912982493, -0.399607052],
    [0, 1, 0],
];

const problemAt = (n) => sphereProblemAt(prism, n, directions);

export async function run({ pool, quick }) {
    const sizes = quick ? [8, 16] : [8, 10, 16, 32, 64];
    const [drawn, ...compared] = await Promise.all([
        pool.run("counterexample", "draw", { n: quick ? 8 : 16 }),
        ...sizes.map((n) => pool.run("counterexample", "compare", { n })),
    ]);
    return { drawn, compared };
}

export const tasks = {
    /** The optimum, and the best of all orders of insertion. */
    compare({ n }) {
        const problem = problemAt(n);
        const files = problemFiles(`counterexample-${n}`, problem);
        const [exact, sequences] = runTool("search_variants", files, [
            40_000_000,
            0,
            "exact",
            "branch-and-bound",
        ]);
        const orders = n <= 16 ? runTool("insertion_orders", files) : null;
        return {
            triangles: problem.target.faces.length,
            optimum: exact.cost,
            optimumProved: exact.gap === 0,
            sequence: sequences.cost,
            sequenceProved: sequences.gap === 0,
            orders: orders?.orders ?? null,
            bestOrder: orders && Math.min(...orders.embeddings.map(({ cost }) => cost)),
        };
    },

    async draw({ n }) {
        const problem = problemAt(n);
        const { embeddings } = runTool(
            "insertion_orders",
            problemFiles("counterexample-drawn", problem),
        );
        const bestOrder = embeddings.reduce((a, b) => (b.cost < a.cost ? b : a));
        const session = await openSession(problemOf(problem));
        const { result: optimum } = await solveAndRecord(session, { gap: 0 });
        const { lengths } = await session.candidatePaths();
        const { result: sequence } = await solveAndRecord(session, {
            gap: 0,
            constraints: keptPaths(bestOrder.paths),
        });
        const differing = optimum.edges
            .filter(({ id, cost }) => Math.abs(cost - sequence.edges[id].cost) > 1e-9 * cost)
            .map(({ id }) => id);
        const views = viewsOf(directions);
        const drawings = views.flatMap((seen, i) =>
            [
                ["optimum", optimum],
                ["sequence", sequence],
            ].map(([name, result]) => ({
                name,
                picture: embeddingPicture(`counterexample-${name}-${i}`, result, {
                    view: seen,
                    highlight: differing,
                }),
            })),
        );
        return {
            drawings,
            edges: optimum.edges.length,
            differing: differing.length,
            order: bestOrder.order,
            // Edges whose path in the optimum is the one that they would take alone.
            alone: optimum.edges.filter(({ id, cost }) => cost <= lengths[id] * (1 + 1e-9)).length,
        };
    },
};

/** Two views of the part of the sphere with the landmarks, from the left and from the right. */
function viewsOf(places) {
    const middle = normalized(
        [0, 1, 2].map((axis) => places.reduce((sum, place) => sum + place[axis], 0)),
    );
    const up = [0, 1, 0];
    const aside = normalized(cross(up, middle));
    return [-0.8, 0.8].map((turn) => ({
        direction: middle.map((x, axis) => x + turn * aside[axis]),
        up,
    }));
}

export function section({ drawn, compared }) {
    const ratios = compared.map(({ optimum, sequence }) => sequence / optimum);
    const enumerated = compared.filter(({ orders }) => orders !== null);
    const flat = pinwheel();
    const rows = compared.map((row) => [
        row.triangles,
        `${number(row.optimum, 4)}${row.optimumProved ? "" : " (not proved)"}`,
        `${number(row.sequence, 4)}${row.sequenceProved ? "" : " (not proved)"}`,
        row.orders === null ? "–" : number(row.bestOrder, 4),
        percent(row.sequence / row.optimum - 1, 2),
    ]);
    return [
        findings(
            "For general graphs there are optimal embeddings that no insertion sequence produces [CHKL13]. None of the known examples is a layout with prescribed cyclic orders around its vertices; whether one exists is left open.",
            `It exists. For a triangular prism on a sphere, with cyclic orders, the best insertion sequence is ${percent(Math.min(...ratios) - 1, 1)} to ${percent(Math.max(...ratios) - 1, 1)} longer than the optimum, on spheres of ${integer(compared[0].triangles)} to ${integer(compared.at(-1).triangles)} triangles. On ${enumerated.length === 1 ? "one of them" : `${enumerated.length} of them`} all ${integer(enumerated[0].orders)} orders of insertion were tried.`,
        ),
        `<h3>General graphs</h3>`,
        flat.svg,
        `<p>Three edges without common vertices (left, each as it would run alone). Every two cross, and the cheapest way out is that each edge turns around the near end of the next one: a pinwheel (middle), of length ${number(flat.optimum)}. An insertion sequence begins with one edge, which runs straight; the others then cannot all give way the short way round (right): ${number(flat.sequence)} at best. In such a graph edges can turn around their end vertices freely. In a layout every vertex has more edges, whose cyclic order is prescribed; they stand in the way of such turns, and detours that a matching allows cost more or are impossible. That is why the known examples do not carry over. It does not exclude others, though.</p>`,
        `<h3>A layout</h3>`,
        pictures(
            drawn.drawings.map(({ name, picture: file }) =>
                picture(file, name === "optimum" ? "the optimum" : "the best insertion sequence"),
            ),
        ),
        `<p class="note">Seen from two sides; red: the ${drawn.differing} of ${drawn.edges} edges whose paths differ. In the optimum only ${drawn.alone} of ${drawn.edges} paths are those that their edges would take alone: an insertion sequence for it could begin with these only, and then is stuck with paths that the optimum does not have. Best order: ${drawn.order.join(", ")}.</p>`,
        table(
            [
                "triangles",
                "optimum (exact)",
                "best sequence (branch and bound)",
                "best of all orders",
                "longer by",
            ],
            rows,
            "Both are proved with tolerance 0 unless the table says otherwise.",
        ),
    ].join("");
}

export function claims(data) {
    const claim = {
        paper: "Whether an optimal embedding of a layout with cyclic orders is always an insertion sequence is open.",
        rule: "Passed if on some instance the proved optimum is shorter than the best of all orders, by enumeration of these.",
        of: ({ compared }) => {
            const enumerated = compared.filter(({ bestOrder }) => bestOrder !== null);
            const shorter = enumerated.filter(
                ({ optimum, optimumProved, bestOrder }) =>
                    optimumProved && optimum < bestOrder * (1 - 1e-9),
            );
            return [
                `answered: it is not, on ${shorter.length} of ${enumerated.length} instances enumerated`,
                judge(shorter.length > 0, true),
            ];
        },
    };
    return claimsOf("6", [claim], data);
}
