// Ours: the path-graph metric against geodesics.
import { problemFiles, runTool } from "./native.mjs";
import { cube, readMember, shippedShapes, sphereProblem } from "./problems.mjs";
import { colours, plot } from "./report/plot.mjs";
import { figure, findings, number, percent, table } from "./report/html.mjs";
import { openSession } from "./solving.mjs";

export const title = "The path-graph metric against geodesics";

/** Native programs that it runs. */
export const tools = () => ["geodesic_comparison"];

export async function run({ pool, quick }) {
    const spheres = (quick ? [12] : [12, 24, 48]).map((n) => ({ sphere: n }));
    const shapes = [
        "quadruped",
        "hand",
        "human",
        "bird",
        "fish",
        "octopus",
        "plane",
        "bust",
        "machine_part",
        "vase",
    ]
        .slice(0, quick ? 3 : 10)
        .map((shape) => ({ shape }));
    return { targets: await pool.all("metric", "compare", [...spheres, ...shapes]) };
}

export const tasks = {
    /** A cube layout on a sphere, or the template of a shape's first member in its second. */
    async compare({ sphere, shape }) {
        let label;
        let problem;
        if (sphere !== undefined) {
            label = `sphere, ${20 * sphere ** 2} triangles`;
            problem = sphereProblem(cube, sphere, 5);
        } else {
            const { title: shown, members } = shippedShapes().find(({ name }) => name === shape);
            label = `${shown}, “${members[1].name}”`;
            const template = readMember(members[0]);
            const session = await openSession({ template, ...readMember(members[1]) });
            await session.loadTarget(template.target);
            const { obj } = await session.templateLayout(template.landmarks);
            problem = { layout: { bytes: obj }, ...readMember(members[1]) };
        }
        const files = problemFiles(`metric-${sphere ?? shape}`, problem);
        const paths = runTool("geodesic_comparison", files, [10_000_000]);
        return { label, isSphere: sphere !== undefined, paths };
    },
};

const known = (paths) => paths.filter(({ geodesic }) => geodesic !== null && geodesic > 0);

function ratios(paths, field) {
    return known(paths)
        .map((path) => path[field] / path.geodesic)
        .sort((a, b) => a - b);
}

function describe(values) {
    const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
    return { mean, median: values[Math.floor(values.length / 2)], largest: values.at(-1) };
}

/** Total over total: what counts for costs. */
function overall(paths, field) {
    const sum = (name) => known(paths).reduce((total, path) => total + path[name], 0);
    return sum(field) / sum("geodesic");
}

export function section({ targets }) {
    const all = targets.flatMap(({ paths }) => paths);
    const spheres = targets.filter(({ isSphere }) => isSphere).flatMap(({ paths }) => paths);
    const costs = ratios(all, "cost");
    const width = 0.01;
    const histogram = new Map();
    for (const value of costs) {
        const bin = Math.floor((value - 1) / width);
        histogram.set(bin, (histogram.get(bin) ?? 0) + 1);
    }
    const bars = [...histogram]
        .filter(([bin]) => bin < 25)
        .map(([bin, n]) => [100 * (bin + 0.5) * width, n / costs.length]);
    return [
        findings(
            "Paths run along edges of the mesh and across edge midpoints; they can deviate from geodesics, especially on badly triangulated targets. Exact geodesics could take their place.",
            `Paths run in a barycentric subdivision of the target. Each path of ${targets.length} embeddings beside the geodesic of its homotopy class: ${percent(overall(all, "cost") - 1, 1)} longer in total, ${percent(describe(costs).median - 1, 1)} in the median; on spheres ${percent(overall(spheres, "cost") - 1, 1)}. Straightened paths (shape short), which have to keep a distance from each other, are ${percent(overall(all, "short") - 1, 1)} longer than geodesics in total. So cost, bound and gap are statements about the path graph.`,
        ),
        figure(
            plot({
                height: 240,
                label: "How much longer paths of the path graph are than geodesics",
                x: { label: "longer than the geodesic, percent", from: 0, to: 25 },
                y: { label: "share of paths", from: 0, format: (y) => percent(y) },
                marks: [{ type: "bars", data: bars, colour: colours.exact, size: 8 }],
            }),
            `${costs.length} paths; ${all.length - costs.length} for which the reference finds no geodesic are left out.`,
        ),
        table(
            [
                "target",
                "paths",
                "path graph: total",
                "largest",
                "even: total",
                "short: total",
                "largest",
            ],
            targets.map(({ label, paths }) => [
                label,
                known(paths).length,
                `+${percent(overall(paths, "cost") - 1, 1)}`,
                `+${percent(describe(ratios(paths, "cost")).largest - 1, 0)}`,
                `+${percent(overall(paths, "even") - 1, 1)}`,
                `+${percent(overall(paths, "short") - 1, 1)}`,
                `+${percent(describe(ratios(paths, "short")).largest - 1, 0)}`,
            ]),
            `Against the locally shortest path in the same class whatever the other paths do, by edge flips in an intrinsic triangulation (Sharp and Crane 2020), written for the tests and independent of the solver. A class can have several locally shortest paths on a surface with cones: ratios below 1 are possible. ${number(describe(ratios(all, "short")).mean, 3)} is the mean ratio in the shape short.`,
        ),
    ].join("");
}
