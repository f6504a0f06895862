// Figs. 2 and 4: several classes of one layout; what the order of insertion does.
import { keptPaths } from "./paths.mjs";
import { cube, prism, problemOf, sphereProblem } from "./problems.mjs";
import { problemFiles, runTool } from "./native.mjs";
import { insertionPicture, embeddingPicture, viewOfEdges } from "./drawing/picture.mjs";
import { claimsOf, judge } from "./report/claims.mjs";
import { colours, plot } from "./report/plot.mjs";
import { figure, findings, integer, number, percent, picture, pictures } from "./report/html.mjs";
import { openSession, solveAndRecord } from "./solving.mjs";

export const title = "Homotopy classes, and the order of insertion (Figs. 2 and 4)";

/** Native programs that it runs. */
export const tools = () => ["insertion_orders"];

export async function run({ pool, quick }) {
    const [classes, orders] = await Promise.all([
        pool.run("order", "classes", { n: quick ? 8 : 16, seed: 5 }),
        pool.run("order", "orders", { n: quick ? 8 : 12, seed: 5 }),
    ]);
    return { classes, orders };
}

export const tasks = {
    /** The best embedding, and the best ones in which a given edge runs elsewhere. */
    async classes({ n, seed }) {
        const session = await openSession(problemOf(sphereProblem(cube, n, seed)));
        const { result: best } = await solveAndRecord(session, { gap: 0 });
        const alternatives = [];
        for (const { id, weakPath } of best.edges) {
            const { result, record } = await solveAndRecord(session, {
                gap: 0,
                constraints: [{ rule: "avoid", edge: id, path: weakPath }],
            });
            alternatives.push({ edge: id, result, record });
        }
        alternatives.sort((a, b) => a.record.cost - b.record.cost);
        const changed = (result) =>
            result.edges
                .filter(({ id, cost }) => Math.abs(cost - best.edges[id].cost) > 1e-9 * cost)
                .map(({ id }) => id);
        const longest = alternatives.at(-1);
        const view = viewOfEdges(longest.result, changed(longest.result));
        const shown = [longest, alternatives[Math.floor(alternatives.length / 2)], alternatives[0]];
        const drawings = shown.map(({ edge, result }, i) => ({
            edge,
            ratio: result.cost / best.cost,
            changed: changed(result).length,
            picture: embeddingPicture(`classes-${i}`, result, { view, highlight: changed(result) }),
        }));
        drawings.push({
            ratio: 1,
            changed: 0,
            picture: embeddingPicture("classes-best", best, { view }),
        });
        const costs = alternatives.map(({ record }) => record.cost / best.cost);
        return { edges: best.edges.length, proved: best.gap === 0, costs, drawings };
    },

    /** All orders of insertion of a prism, and how the best and the worst one come about. */
    async orders({ n, seed }) {
        const problem = sphereProblem(prism, n, seed);
        const all = runTool("insertion_orders", problemFiles("orders", problem));
        const session = await openSession(problemOf(problem));
        const { result: best, record } = await solveAndRecord(session, { gap: 0 });
        const embeddings = [...all.embeddings].sort((a, b) => a.cost - b.cost);
        const rows = [];
        const view = viewOfEdges(
            best,
            best.edges.map(({ id }) => id),
        );
        for (const [name, candidates] of [
            ["best", embeddings],
            ["typical", embeddings.slice(embeddings.indexOf(quantile(embeddings, 0.5)))],
            ["worst", [...embeddings].reverse()],
        ]) {
            const { embedding, result } = await firstRealised(session, candidates);
            const steps = [3, 5, 7, embedding.order.length].map((count) => ({
                count,
                picture: insertionPicture(
                    `orders-${name}-${count}`,
                    result,
                    embedding.order.slice(0, count),
                    { view },
                ),
            }));
            rows.push({ name, cost: embedding.cost, order: embedding.order, steps });
        }
        return {
            edges: best.edges.length,
            total: all.orders,
            blocked: all.blocked,
            optimum: record.cost,
            proved: record.gap === 0,
            embeddings: embeddings.map(({ cost, orders }) => ({ cost, orders })),
            rows,
        };
    },
};

/** The first of some embeddings whose classes the package finds again from the bare paths. */
async function firstRealised(session, embeddings) {
    for (const embedding of embeddings) {
        const { result } = await solveAndRecord(session, {
            gap: 0,
            workLimit: 500_000,
            constraints: keptPaths(embedding.paths),
        });
        if (result.refined !== null) {
            return { embedding, result };
        }
    }
    throw new Error("none of the embeddings was found again");
}

/** The embedding below which this share of the orders ends. */
function quantile(embeddings, share) {
    const total = embeddings.reduce((sum, { orders }) => sum + orders, 0);
    let sum = 0;
    return embeddings.find(({ orders }) => (sum += orders) >= share * total);
}

export function section({ classes, orders }) {
    const complete = orders.total - orders.blocked;
    const best = orders.embeddings[0];
    const worst = orders.embeddings.at(-1);
    let sum = 0;
    const cumulative = orders.embeddings.map(({ cost, orders: n }) => {
        sum += n / orders.total;
        return [cost / best.cost, sum];
    });
    const end = cumulative.at(-1);
    const chart = plot({
        height: 260,
        label: "Share of insertion orders that end with an embedding of at most a given length",
        x: {
            label: "length / that of the best order",
            from: 1,
            to: end[0],
        },
        y: { label: "share of orders", from: 0, to: 1, format: (y) => percent(y) },
        marks: [{ type: "steps", data: [[1, 0], ...cumulative], colour: colours.exact }],
    });
    return [
        findings(
            "Infinitely many classes are possible for given landmarks; embeddings of least total length correspond to the expected one (Fig. 2). Inserting the same edges in another order gives other paths and patches in other homotopy classes (Fig. 4).",
            `On a cube layout, forbidding one edge’s route makes the best embedding ${number(Math.min(...classes.costs), 3)} to ${number(Math.max(...classes.costs), 2)} times as long${classes.proved ? " (each with proof)" : ""}. On a triangular prism all ${integer(orders.total)} orders of its ${orders.edges} edges were tried: they end in ${orders.embeddings.length} different embeddings, the longest ${number(worst.cost / best.cost)} times the shortest; ${percent(best.orders / orders.total)} of the orders find the shortest and ${percent(orders.blocked / orders.total)} end with an edge that has no path left.`,
        ),
        `<h3>Classes of one layout</h3>`,
        pictures(
            classes.drawings.map(({ ratio, changed, edge, picture: file }) =>
                picture(
                    file,
                    edge === undefined
                        ? "the shortest embedding"
                        : `${number(ratio)} times as long: edge ${edge} runs elsewhere, ${changed} paths differ (red)`,
                ),
            ),
        ),
        `<h3>Order of insertion</h3>`,
        ...orders.rows.map(({ name, cost, order, steps }) =>
            pictures(
                steps.map(({ count, picture: file }) =>
                    picture(
                        file,
                        count === order.length
                            ? `${name}: all ${count}, ${number(cost / best.cost)} times the best order`
                            : `edges ${order.slice(0, count).join(", ")}`,
                        `${name} order after ${count} insertions`,
                    ),
                ),
            ),
        ),
        `<p class="note">The same layout on the same landmarks: an order that ends with the shortest embedding, one with the median length of all orders that end with an embedding, and the longest one that could be drawn (embeddings are realised from their homotopy classes, which for very long paths are not found again). Red: the last edge inserted.</p>`,
        figure(
            chart,
            `All ${integer(orders.total)} orders (${integer(complete)} end with an embedding). Orders that lead to the same partial embedding were followed once.`,
        ),
    ].join("");
}

export function claims(data) {
    const claim = {
        paper: "Different insertion sequences of the same edges can give different embeddings, and some give none (Fig. 4).",
        rule: "Of all orders of one layout at least two end in different embeddings, and some in none.",
        of: ({ orders: { embeddings, blocked, total } }) => [
            `${embeddings.length} embeddings; ${percent(blocked / total)} of the orders end without`,
            judge(embeddings.length > 1 && blocked > 0),
        ],
    };
    return claimsOf("3.1", [claim], data);
}
