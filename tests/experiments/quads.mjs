// Figs. 3 and 14: quad meshes with the same base complex on several targets.
import { cross, dot, minus } from "../bench/vectors.mjs";
import { quadPicture, viewOfEdges } from "./drawing/picture.mjs";
import { heuristics, names } from "./methods.mjs";
import { generatedShapes, readMember, shippedShapes } from "./problems.mjs";
import { claimsOf, judge } from "./report/claims.mjs";
import { findings, number, percent, picture, pictures, table } from "./report/html.mjs";
import { loadProblem, openSession, solveAndRecord } from "./solving.mjs";

export const title = "Quad meshes with a prescribed base complex (Figs. 3 and 14)";

/** Native programs that it runs. */
export const tools = (quick) => (quick ? [] : ["generate_shapes"]);

/** An embedding of a heuristic counts as failed if it is so many times as long as the best. */
const failure = 1.05;

export async function run({ pool, quick }) {
    const shapes = quick ? shippedShapes() : await generatedShapes();
    const classes = await Promise.all(
        (quick ? ["hand"] : ["hand", "human"]).map(async (name) => {
            const { members, title: classTitle } = shapes.find((shape) => shape.name === name);
            const sources = await pool.all(
                "quads",
                "findFailures",
                members.map((source) => ({
                    source,
                    targets: members.filter((member) => member !== source),
                })),
            );
            // The layout with the worst failures, on the targets where they are.
            const excess = ({ failures }) => failures.reduce((sum, { ratio }) => sum + ratio, 0);
            const { source, failures } = sources.reduce((p, q) => (excess(q) > excess(p) ? q : p));
            const rows = await pool.all(
                "quads",
                "mesh",
                failures.map((failed) => ({ name, source, ...failed })),
            );
            const tried = members.length * (members.length - 1);
            return { classTitle, source: source.name, tried, rows };
        }),
    );
    return { classes };
}

export const tasks = {
    /** The three targets on which a heuristic fails worst, with the heuristic. */
    async findFailures({ source, targets }) {
        const failures = [];
        for (const target of targets) {
            const session = await openSession({
                template: readMember(source),
                quads: true,
                ...readMember(target),
            });
            const { result: best } = await solveAndRecord(session, {
                gap: 0,
                workLimit: 4_000_000,
            });
            for (const heuristic of heuristics) {
                const { result } = await solveAndRecord(session, { algorithm: heuristic });
                const ratio = result.refined === null ? 0 : result.cost / best.cost;
                if (ratio > failure) {
                    failures.push({ target, ratio, heuristic });
                }
            }
            await session.dispose();
        }
        failures.sort((a, b) => b.ratio - a.ratio);
        const worst = failures.filter(
            ({ target }, i) => failures.findIndex((other) => other.target === target) === i,
        );
        return { source, failures: worst.slice(0, 3) };
    },

    /** Quad meshes of the best and of a heuristic's embedding. */
    mesh({ name, source, target, ratio, heuristic }) {
        return meshesOn(name, source, target, ratio, heuristic);
    },
};

async function meshesOn(name, source, target, ratio, heuristic) {
    const session = await openSession({
        template: readMember(source),
        quads: true,
        ...readMember(source),
    });
    // Numbers of segments come from the template's own shape, so that connectivities are the same.
    const { result } = await solveAndRecord(session, { gap: 0 });
    const { segments, quads: templateQuads } = await session.quads({
        edgeLength: Math.sqrt(areaOf(result.refined) / 1500),
    });
    await loadProblem(session, {
        template: readMember(source),
        quads: true,
        ...readMember(target),
    });
    const { result: greedy } = await solveAndRecord(session, {
        algorithm: heuristic,
        shape: "fair",
    });
    const greedyQuads = await attempt(() => session.quads({ segmentsAs: segments }));
    const { result: exact } = await solveAndRecord(session, { gap: 0, shape: "fair" });
    const exactQuads = await attempt(() => session.quads({ segmentsAs: segments }));
    const detours = greedy.edges
        .filter(({ id, cost }) => cost > 1.25 * exact.edges[id].cost)
        .map(({ id }) => id);
    const view = viewOfEdges(greedy, detours);
    const described = (quads, label) =>
        quads.error
            ? { error: quads.error }
            : {
                  ...quads.statistics,
                  quads: quads.quads.length / 4,
                  sameQuads: quads.quads.every((vertex, i) => vertex === templateQuads[i]),
                  picture: quadPicture(`quads-${name}-${target.name}-${label}`, quads, { view }),
              };
    return {
        target: target.name,
        ratio,
        heuristic,
        meshes: [
            { algorithm: heuristic, ...described(greedyQuads, heuristic) },
            { algorithm: "exact", ...described(exactQuads, "exact") },
        ],
    };
}

function areaOf({ positions, corners }) {
    let area = 0;
    for (let t = 0; t < corners.length; t += 3) {
        const [a, b, c] = [0, 1, 2].map((k) =>
            positions.subarray(3 * corners[t + k], 3 * corners[t + k] + 3),
        );
        const normal = cross(minus(b, a), minus(c, a));
        area += Math.sqrt(dot(normal, normal)) / 2;
    }
    return area;
}

/** The result of an action, or { error } with its message. */
async function attempt(action) {
    try {
        return await action();
    } catch (error) {
        return { error: error.message };
    }
}

export function section({ classes }) {
    const rows = classes.flatMap(({ rows: all }) => all);
    const of = (algorithm) =>
        rows.flatMap(({ meshes }) =>
            meshes.filter((mesh) => (mesh.algorithm === "exact") === (algorithm === "exact")),
        );
    const worst = (meshes, field) =>
        Math.max(...meshes.filter(({ error }) => !error).map((mesh) => mesh[field]));
    const failed = of("greedy").filter(({ error }) => error).length;
    return [
        findings(
            "One quad layout in three hands: all quad meshes have the same base complex, but those of greedy embeddings are distorted where paths are in undesired classes; branch and bound gives the expected classes and clean meshes in all examples.",
            `All quad layouts of the members in each other (${classes.map(({ tried }) => tried).join(" and ")} pairs); per class, the layout with the worst failures of heuristics (more than ${percent(failure - 1)} longer) is shown on the targets where they are. The same numbers of segments on all, so that meshes of a class have the same connectivity. Angles deviate by at most ${number(worst(of("exact"), "angleDeviation"), 0)}° (root mean square) on the exact method’s embeddings, by up to ${number(worst(of("greedy"), "angleDeviation"), 0)}° on the greedy ones${failed > 0 ? `; on ${failed} of these no quad mesh could be made` : ""}.`,
        ),
        ...classes.map(
            ({ classTitle, source, rows: all }) =>
                `<h3>${classTitle}: the layout of “${source}”</h3>${pictures(
                    all.flatMap(({ target, ratio, meshes }) =>
                        meshes.map(({ algorithm, picture: file, error }) =>
                            error
                                ? `<figure class="picture"><figcaption>“${target}”, ${names[algorithm]}: ${error}</figcaption></figure>`
                                : picture(
                                      file,
                                      algorithm === "exact"
                                          ? `“${target}”, exact`
                                          : `“${target}”, ${names[algorithm]}, paths ${number(ratio)} times as long`,
                                  ),
                        ),
                    ),
                )}`,
        ),
        table(
            [
                "target",
                "embedding",
                "quads",
                "mean scaled Jacobian",
                "flipped or not convex",
                "deviation from 90°",
                "longest / mean edge",
            ],
            rows.flatMap(({ target, meshes }) =>
                meshes.map((mesh) =>
                    mesh.error
                        ? [target, names[mesh.algorithm], "–", "–", "–", "–", "–"]
                        : [
                              target,
                              names[mesh.algorithm],
                              mesh.quads,
                              number(mesh.meanJacobian),
                              percent(mesh.flipped / mesh.quads, 1),
                              `${number(mesh.angleDeviation, 1)}°`,
                              number(mesh.largestEdge / mesh.meanEdge, 1),
                          ],
                ),
            ),
            "Paths in the shape fair, as the paper’s pipeline smooths them [PSS01].",
        ),
    ].join("");
}

const claimed = [
    {
        paper: "All quad meshes of a layout share the same base complex.",
        rule: "The meshes of a class have the same quads as lists of vertices, on all targets and from all embeddings.",
        of: ({ classes }) => {
            const meshes = meshesOfAll(classes);
            const same = meshes.filter(({ sameQuads }) => sameQuads);
            return [
                `${same.length} of ${meshes.length} meshes`,
                judge(same.length === meshes.length),
            ];
        },
    },
    {
        paper: "Greedy embeddings give distorted quad meshes; the embeddings of branch and bound allow clean ones in all experiments.",
        rule: "On every target shown the mesh of the exact method exists, has the larger mean scaled Jacobian, and at most 4 % of its quads are flipped or not convex.",
        of: ({ classes }) => {
            const rows = classes.flatMap(({ rows: all }) => all);
            const good = rows.filter(
                ({ meshes: [greedy, exact] }) =>
                    !exact.error &&
                    exact.flipped <= 0.04 * exact.quads &&
                    (greedy.error || exact.meanJacobian > greedy.meanJacobian),
            );
            return [`${good.length} of ${rows.length} targets`, judge(good.length === rows.length)];
        },
    },
];

function meshesOfAll(classes) {
    return classes
        .flatMap(({ rows }) => rows)
        .flatMap(({ meshes }) => meshes)
        .filter(({ error }) => !error);
}

export function claims(data) {
    return claimsOf("5.3", claimed, data);
}
