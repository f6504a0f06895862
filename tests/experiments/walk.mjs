// Fig. 13: landmarks on random walks, and what embeddings make of them.
import { Random } from "../bench/generate.mjs";
import { dot, minus, normalized } from "../bench/vectors.mjs";
import { keptPaths } from "./paths.mjs";
import { afterStep, rings } from "./landmark_walk.mjs";
import { embeddingPicture, viewOfEdges } from "./drawing/picture.mjs";
import { algorithms, colourOf, heuristics, names } from "./methods.mjs";
import { generatedShapes, readMember, shippedShapes } from "./problems.mjs";
import { claimsOf, judge } from "./report/claims.mjs";
import { plot } from "./report/plot.mjs";
import { count, figure, findings, number, picture, pictures, table } from "./report/html.mjs";
import { openSession, solveAndRecord } from "./solving.mjs";

export const title = "Landmarks on random walks (Fig. 13)";

/** Native programs that it runs. */
export const tools = (quick) => (quick ? [] : ["generate_shapes"]);

export async function run({ pool, quick }) {
    const shapes = quick ? shippedShapes() : await generatedShapes();
    const classes = quick ? ["hand"] : ["hand", "quadruped", "human"];
    const inputs = classes.map((name) => {
        const { members, title: shown } = shapes.find((shape) => shape.name === name);
        return {
            name,
            shown,
            member: members[0],
            seed: 1,
            rounds: quick ? 4 : 8,
            workLimit: quick ? 2_000_000 : 3_000_000,
        };
    });
    return { walks: await pool.all("walk", "follow", inputs) };
}

export const tasks = {
    async follow({ name, shown, member, seed, rounds, workLimit }) {
        const { target, landmarks } = readMember(member);
        const session = await openSession({ template: { target, landmarks }, target, landmarks });
        const { positions, corners } = await session.loadTarget(target);
        const { landmarks: first } = await session.setLandmarks(landmarks);
        const solve = async (options) =>
            (await solveAndRecord(session, { workLimit, ...options })).result;
        const start = await solve({ gap: 0 });
        const motion = new Motion(positions, corners, first, start, seed);
        const states = [];
        for (let round = 0; round <= rounds; ++round) {
            const allowed = round > 0 ? motion.advance() : 0;
            await session.setLandmarks(motion.landmarks);
            const kept = await solve({ gap: 0, constraints: keptPaths(motion.paths) });
            const results = { exact: await solve({ gap: 0 }) };
            for (const algorithm of [...heuristics, "branch-and-bound"]) {
                results[algorithm] = await solve({ algorithm });
            }
            states.push({ distance: motion.travelled(), allowed, kept, results });
        }
        // The state with the longest heuristic embedding is drawn.
        const excess = ({ results }) =>
            Math.max(
                ...heuristics.map((algorithm) =>
                    results[algorithm].refined ? results[algorithm].cost / results.exact.cost : 0,
                ),
            );
        const drawn = states.reduce((a, b) => (excess(b) > excess(a) ? b : a));
        const worst = heuristics.reduce((a, b) =>
            (drawn.results[b].refined ? drawn.results[b].cost : 0) >
            (drawn.results[a].refined ? drawn.results[a].cost : 0)
                ? b
                : a,
        );
        const detours = drawn.results[worst].edges
            .filter(({ id, cost }) => cost > 1.25 * drawn.results.exact.edges[id].cost)
            .map(({ id }) => id);
        const view = viewOfEdges(drawn.results[worst], detours);
        const drawings = [
            ["at the beginning, exact", start],
            [`after ${number(drawn.distance)}, ${names[worst]}`, drawn.results[worst]],
            [`after ${number(drawn.distance)}, exact`, drawn.results.exact],
        ].map(([label, result], i) => ({
            label,
            picture: embeddingPicture(`walk-${name}-${i}`, result, {
                view,
                highlight: i === 0 ? [] : detours,
            }),
        }));
        const isSame = (result, kept) => Math.abs(result.cost - kept.cost) <= 1e-9 * kept.cost;
        return {
            shown,
            member: member.name,
            landmarks: first.length,
            drawings,
            states: states.map(({ distance, allowed, kept, results }) => ({
                distance,
                allowed,
                kept: kept.refined === null ? null : kept.cost,
                keptProved: kept.gap === 0,
                costs: Object.fromEntries(
                    Object.entries(results).map(([algorithm, { cost, refined, gap }]) => [
                        algorithm,
                        {
                            cost: refined === null ? null : cost,
                            gap,
                            same:
                                kept.refined !== null && refined !== null && isSame({ cost }, kept),
                        },
                    ]),
                ),
            })),
        };
    },
};

/** Landmarks that wander over the target's vertices, with the paths that follow them. */
class Motion {
    constructor(positions, corners, landmarks, result, seed) {
        this.positions = positions;
        this.rings = rings(positions.length / 3, corners);
        this.landmarks = Array.from(landmarks);
        this.paths = result.edges.map(({ weakPath }) => weakPath);
        this.degrees = this.landmarks.map(
            (_, v) => result.edges.filter(({ layoutEdge }) => layoutEdge.includes(v)).length,
        );
        this.random = new Random(seed);
        this.directions = this.landmarks.map(() => this.random.direction());
        this.distances = this.landmarks.map(() => 0);
        // Distances are told in mean lengths of the embedding's paths.
        this.unit = result.cost / result.edges.length;
    }

    position(v) {
        return Array.from(this.positions.subarray(3 * v, 3 * v + 3));
    }

    /**
     * Moves each landmark by one edge, roughly straight on. Returns by how much the shortest
     * embedding of any class can have changed: by the step at every path's end.
     */
    advance() {
        let allowed = 0;
        this.landmarks.forEach((p, i) => {
            const ways = this.rings[p]
                .map((q) => ({ q, step: minus(this.position(q), this.position(p)) }))
                .map((way) => ({
                    ...way,
                    rank: dot(normalized(way.step), this.directions[i]) + 0.8 * this.random.unit(),
                }))
                .sort((a, b) => b.rank - a.rank);
            for (const { q, step } of ways) {
                const paths = this.landmarks.includes(q)
                    ? null
                    : afterStep(this.paths, p, q, this.rings[q]);
                if (paths !== null) {
                    this.paths = paths;
                    this.landmarks[i] = q;
                    this.directions[i] = normalized(step);
                    const length = Math.sqrt(dot(step, step));
                    this.distances[i] += length;
                    allowed += length * this.degrees[i];
                    break;
                }
            }
        });
        return allowed;
    }

    /** The mean distance that the landmarks have travelled. */
    travelled() {
        return (
            this.distances.reduce((sum, distance) => sum + distance, 0) /
            this.distances.length /
            this.unit
        );
    }
}

/** The largest change of the cost from one state to the next, relative to what motion explains. */
function largestJump(states, algorithm) {
    const jumps = states.slice(1).map(({ costs, allowed }, i) => {
        const [before, after] = [states[i].costs[algorithm].cost, costs[algorithm].cost];
        return before === null || after === null ? 0 : Math.abs(after - before) / allowed;
    });
    return Math.max(...jumps);
}

const classKept = ({ states }, algorithm) =>
    states.filter(({ costs }) => costs[algorithm].same).length;

export function section({ walks }) {
    const parts = walks.map((walk) => {
        const chart = plot({
            height: 260,
            label: `Costs while the landmarks of ${walk.member} move`,
            x: { label: "mean distance travelled / mean length of paths", from: 0 },
            y: { label: "total length" },
            marks: algorithms.map((algorithm) => ({
                type: "line",
                data: walk.states
                    .filter(({ costs }) => costs[algorithm].cost !== null)
                    .map(({ distance, costs }) => [distance, costs[algorithm].cost]),
                colour: colourOf[algorithm],
                name: names[algorithm],
            })),
        });
        return `<h3>${walk.shown}: “${walk.member}”, ${walk.landmarks} landmarks</h3>${figure(chart, "")}${pictures(walk.drawings.map(({ label, picture: file }) => picture(file, label)))}`;
    });
    const rows = walks.flatMap((walk) =>
        algorithms.map((algorithm) => [
            `${walk.member}, ${names[algorithm]}`,
            `${classKept(walk, algorithm)} of ${walk.states.length}`,
            number(largestJump(walk.states, algorithm)),
            walk.states.filter(({ costs }) => costs[algorithm].cost === null).length,
        ]),
    );
    const states = walks.reduce((sum, walk) => sum + walk.states.length, 0);
    const kept = (algorithm) => walks.reduce((sum, walk) => sum + classKept(walk, algorithm), 0);
    return [
        findings(
            "Landmarks move along random trajectories. Already for mild perturbations greedy methods introduce swirls, and their cost changes discontinuously; the cost of branch and bound increases gradually, and all paths remain in their initial homotopy class.",
            `Landmarks walk over the vertices of ${count(walks.length, "shape")}. The initial class is carried along by pushing paths ahead of every moving landmark, so that it is known which class counts as the initial one. In ${kept("exact")} of ${states} states the exact method’s embedding lies in it, branch and bound’s in ${kept("branch-and-bound")}, those of the heuristics in ${heuristics.map((algorithm) => kept(algorithm)).join(", ")}.`,
        ),
        ...parts,
        table(
            [
                "walk and method",
                "in the initial class",
                "largest change of the cost",
                "without embedding",
            ],
            rows,
            "The largest change of the cost from one state to the next, relative to what the motion explains: while the class stays, every path can follow its ends, so the shortest embedding changes by at most the landmarks’ steps, counted once per path that ends there. Above 1 the cost is discontinuous. An embedding counts as in the initial class if it costs, to nine digits, what the shortest embedding of that class costs. Where the exact method leaves the class with a proof, another one has become shorter.",
        ),
    ].join("");
}

const claimed = [
    {
        paper: "Greedy methods change homotopy classes already for mild perturbations, and their cost jumps.",
        rule: "The cost of every heuristic changes on some walk by more than the motion explains.",
        of: ({ walks }) => {
            const jumps = heuristics.map((algorithm) => largestOf(walks, algorithm));
            return [
                `${jumps.map((jump) => number(jump)).join(", ")} times as much`,
                judge(Math.min(...jumps) > 1),
            ];
        },
    },
    {
        paper: "The cost of branch and bound increases gradually.",
        rule: "On no walk the cost of branch and bound or of the exact method changes by more than the motion explains.",
        of: ({ walks }) => {
            const jumps = ["branch-and-bound", "exact"].map((algorithm) =>
                largestOf(walks, algorithm),
            );
            return [
                `${jumps.map((jump) => number(jump)).join(", ")} times as much`,
                judge(Math.max(...jumps) <= 1),
            ];
        },
    },
    {
        paper: "All paths of branch and bound remain in their initial class.",
        rule: "Branch and bound and the exact method are in the initial class in all states.",
        of: ({ walks }) => {
            const states = walks.reduce((sum, walk) => sum + walk.states.length, 0);
            const kept = ["branch-and-bound", "exact"].map((algorithm) =>
                walks.reduce((sum, walk) => sum + classKept(walk, algorithm), 0),
            );
            const shorter = walks
                .flatMap((walk) => walk.states)
                .filter(
                    ({ kept: carried, costs: { exact } }) =>
                        !exact.same && exact.gap === 0 && carried !== null && exact.cost < carried,
                ).length;
            return [
                `${kept.join(" and ")} of ${states} states; in ${shorter} the initial class is proved not to be the shortest any more`,
                judge(kept.every((n) => n === states)),
            ];
        },
    },
];

function largestOf(walks, algorithm) {
    return Math.max(...walks.map(({ states }) => largestJump(states, algorithm)));
}

export function claims(data) {
    return claimsOf("5.2", claimed, data);
}
