// Ours: what the parts of the exact method contribute.
import { problemFiles, runTool } from "./native.mjs";
import { cube, displacedProblem, randomHull, sphereProblem } from "./problems.mjs";
import { boundsOverTime } from "./histories.mjs";
import { colours, plot } from "./report/plot.mjs";
import { figure, findings, number, percent, seconds, table } from "./report/html.mjs";

export const title = "What the parts of the exact method contribute";

/** Native programs that it runs. */
export const tools = () => ["search_variants"];

const variants = [
    { variant: "exact", name: "exact", colour: colours.exact },
    {
        variant: "exact-local-search",
        name: "without look-ahead and local search",
        colour: colours.schreiner,
    },
    { variant: "exact-exploration", name: "without exploration of classes", colour: colours.praun },
    { variant: "exact-faces", name: "without what faces demand", colour: colours.kraevoy },
    {
        variant: "branch-and-bound",
        name: "branch and bound in its place",
        colour: colours.branchAndBound,
    },
];

function problems(quick) {
    const n = quick ? 12 : 24;
    const cubes = (quick ? [2] : [1, 2, 3, 4, 5, 6]).map((seed) => ({
        name: `cube, random landmarks ${seed}`,
        make: () => sphereProblem(cube, n, seed),
    }));
    const hulls = (
        quick
            ? [[12, 0.3]]
            : [
                  [12, 0.3],
                  [12, 0.5],
                  [20, 0.2],
                  [20, 0.3],
                  [20, 0.5],
                  [30, 0.2],
                  [30, 0.3],
              ]
    ).map(([points, distance]) => ({
        name: `hull of ${points} points, displaced by ${distance}`,
        make: () => displacedProblem(randomHull(points, 1), n, distance, 2),
    }));
    return [...cubes, ...hulls];
}

export async function run({ pool, quick }) {
    const workLimit = quick ? 2_000_000 : 10_000_000;
    const inputs = problems(quick).map((_, index) => ({ index, quick, workLimit }));
    return { workLimit, instances: await pool.all("parts", "compare", inputs) };
}

export const tasks = {
    compare({ index, quick, workLimit }) {
        const { name, make } = problems(quick)[index];
        const problem = make();
        const files = problemFiles(`parts-${index}`, problem);
        const results = runTool("search_variants", files, [
            workLimit,
            0,
            ...variants.map(({ variant }) => variant),
        ]);
        return { name, triangles: problem.target.faces.length, results };
    },
};

const isProved = ({ cost, gap }) => cost !== null && gap === 0;

export function section(data) {
    const proved = variants.map(
        (_, i) => data.instances.filter(({ results }) => isProved(results[i])).length,
    );
    const hardest = data.instances.reduce((a, b) => (b.results[0].cpu > a.results[0].cpu ? b : a));
    const begin = 0.01;
    const end = 1.2 * Math.max(...hardest.results.map(({ cpu }) => cpu));
    const best = Math.min(...hardest.results.map(({ cost }) => cost ?? Infinity));
    const marks = variants.flatMap(({ name, colour }, i) => {
        const { costs, bounds } = boundsOverTime(
            { ...hardest.results[i], cpuSearch: hardest.results[i].cpu },
            begin,
        );
        const relative = (points) => points.map(([x, y]) => [x, y / best]);
        return [
            { type: "steps", data: relative(costs).filter(([, y]) => y < 1.5), colour, name },
            { type: "steps", data: relative(bounds), colour, dashed: true },
        ];
    });
    const stages = data.instances.map(({ name, results: [exact] }) => {
        const first = exact.history.find(({ cost }) => cost !== null);
        const bounds = exact.history.filter(({ lowerBound }) => lowerBound > 0);
        return [
            name,
            number(first?.cost / exact.cost, 3),
            number(bounds[0]?.lowerBound / exact.cost, 3),
            number(exact.lowerBound / exact.cost, 3),
        ];
    });
    return [
        findings(
            "(The paper has no such method; its own bound is the sum of candidate paths.)",
            `Layouts with displaced or random landmarks on spheres, tolerance 0, at most ${data.workLimit / 1e6} million units of work, native programs. Proved optimal, of ${data.instances.length}: ${variants.map(({ name }, i) => `${name} ${proved[i]}`).join("; ")}. Branch and bound proves its optimum among insertion sequences only.`,
        ),
        figure(
            plot({
                label: `Costs and bounds of the variants, ${hardest.name}`,
                x: { label: "CPU seconds (logarithmic)", log: true, from: begin, to: end },
                y: { label: "length / best" },
                marks,
            }),
            `${hardest.name}, where the exact method takes longest: best embeddings (solid) and lower bounds (dashed).`,
        ),
        table(
            ["instance", ...variants.flatMap(({ name }) => [`${name}: gap`, "CPU"])],
            data.instances.map(({ name, results }) => [
                name,
                ...results.flatMap((result) => [percent(result.gap, 2), seconds(result.cpu)]),
            ]),
        ),
        table(
            ["instance", "first embedding", "first bound (shortest paths alone)", "last bound"],
            stages,
            "Relative to the exact method’s last embedding: what plain greedy insertion begins with, what the sum of unconstrained shortest paths proves, and what the selection of classes adds to that.",
        ),
    ].join("");
}
