// Fig. 12: branch and bound with one of its features switched off at a time.
import { cumulative } from "./histories.mjs";
import { problemFiles, runTool } from "./native.mjs";
import { generatedShapes, readMember, shippedShapes } from "./problems.mjs";
import { claimsOf, judge } from "./report/claims.mjs";
import { plot } from "./report/plot.mjs";
import { count, figure, findings, integer, percent, seconds, table } from "./report/html.mjs";
import { openSession, withoutHistory } from "./solving.mjs";

export const title = "What the features of branch and bound contribute (Fig. 12)";

/** Native programs that it runs. */
export const tools = (quick) => ["search_variants", ...(quick ? [] : ["generate_shapes"])];

/**
 * The paper’s features, each left out in turn, without a greedy start as in the paper; then what is
 * not in the paper. Names as search_variants.cc knows them.
 */
const variants = [
    { without: "", name: "all of the paper’s features", colour: "#0072b2" },
    { without: "-redundant", name: "no detection of redundant states", colour: "#00563f" },
    { without: "-delay", name: "non-conflicting edges not delayed", colour: "#6cc24a" },
    { without: "-priority", name: "best-first priority", colour: "#d4b106" },
    { without: "-candidates", name: "bounds without candidate paths", colour: "#e67300" },
    { without: "-memory", name: "no memory of searches (ours)", colour: "#8a4fbf", dashed: true },
    { name: "with bounds from pairs (ours)", colour: "#cc79a7", dashed: true },
].map(({ without, ...variant }) => ({
    ...variant,
    variant: `branch-and-bound-start${without === undefined ? "" : `-pairs${without}`}`,
}));
const tolerance = 0.01;

/** Which instances of the collection are taken: those that branch and bound has finished. */
function instancesOf(collection, classes, quick) {
    const finished = collection.instances.filter(
        ({ genus, boundaryLoops, records }) =>
            genus === 0 && boundaryLoops === 0 && records["branch-and-bound"].gap <= tolerance,
    );
    const wanted = quick ? 6 : 24;
    const step = Math.max(1, finished.length / wanted);
    return Array.from({ length: Math.min(wanted, finished.length) }, (_, i) => {
        const { name, source, target } = finished[Math.floor(i * step)];
        const { members } = classes.find((shape) => shape.name === name);
        const member = (wantedName) => members.find((shape) => shape.name === wantedName);
        return { name, source: member(source), target: member(target) };
    });
}

export async function run({ pool, quick, done }) {
    if (done.collection === undefined) {
        return null;
    }
    const classes = quick ? shippedShapes() : await generatedShapes();
    const workLimit = quick ? 1_000_000 : 6_000_000;
    const chosen = instancesOf(done.collection.data, classes, quick);
    const instances = await pool.all(
        "ablation",
        "compare",
        chosen.map((instance) => ({ ...instance, workLimit })),
    );
    return { workLimit, instances };
}

export const tasks = {
    async compare({ name, source, target, workLimit }) {
        const template = readMember(source);
        const problem = readMember(target);
        const session = await openSession({ template, ...problem });
        await session.loadTarget(template.target);
        const { obj } = await session.templateLayout(template.landmarks);
        const label = `${name}-${target.name}`;
        const files = problemFiles(`ablation-${label}`, { layout: { bytes: obj }, ...problem });
        const results = runTool("search_variants", files, [
            workLimit,
            tolerance,
            ...variants.map(({ variant }) => variant),
        ]);
        return {
            label,
            results: results.map(withoutHistory),
        };
    },
};

const isProved = ({ finished, cost, gap }) => finished && cost !== null && gap <= tolerance;

/** CPU seconds until each instance was proved; Infinity if it was not. */
function timesOf(data, i) {
    return data.instances.map(({ results }) => (isProved(results[i]) ? results[i].cpu : Infinity));
}

export function section(data) {
    if (data === null) {
        return "<p>Not made: it needs the experiment on the classes of shapes in the same run.</p>";
    }
    const begin = 0.005;
    const end = Math.max(...data.instances.flatMap(({ results }) => results.map(({ cpu }) => cpu)));
    const share = (i) => timesOf(data, i).filter(Number.isFinite).length / data.instances.length;
    const total = (i, field) =>
        data.instances.reduce((sum, { results }) => sum + results[i][field], 0);
    return [
        findings(
            "On the instances finished within five minutes, without a greedy start: detection of redundant states matters for hard instances only; without delaying non-conflicting insertions almost all instances take longer; with best-first priority or bounds that ignore candidate paths only very few terminate.",
            `${count(data.instances.length, "instance")} of the collection that branch and bound has finished, without a greedy start, at most ${data.workLimit / 1e6} million units of work, native programs. Proved to 1 %: ${variants.map(({ name }, i) => `${name} ${percent(share(i))}`).join("; ")}.`,
        ),
        figure(
            plot({
                label: "Share of instances proved over time, per configuration",
                x: { label: "CPU seconds (logarithmic)", log: true, from: begin, to: 1.2 * end },
                y: { label: "share proved to 1 %", from: 0, to: 1, format: (y) => percent(y) },
                marks: variants.map(({ name, colour, dashed }, i) => ({
                    type: "steps",
                    data: cumulative(timesOf(data, i), begin, 1.2 * end),
                    colour,
                    name,
                    dashed,
                })),
            }),
            "Share of instances that have terminated with a proof to 1 % within a given time.",
        ),
        table(
            ["configuration", "proved", "CPU time of all", "states", "shortest-path searches"],
            variants.map(({ name }, i) => [
                name,
                `${timesOf(data, i).filter(Number.isFinite).length}`,
                seconds(total(i, "cpu")),
                integer(total(i, "states")),
                integer(total(i, "searches")),
            ]),
            "The memory of searches, which all lines but one have, answers questions for shortest paths from what earlier searches have met; bounds from pairs add what two edges in conflict cost together. The paper has neither.",
        ),
    ].join("");
}

const provedOf = (data, i) => timesOf(data, i).filter(Number.isFinite).length;

const claimed = [
    {
        paper: "Without detection of redundant states runs on simple inputs take as long as with it; some hard ones time out.",
        rule: "Proves at least 60 % of what all features prove, and no more.",
        of: (data) => {
            const [all, without] = [0, 1].map((i) => provedOf(data, i));
            return [
                `${without} against ${all} proved`,
                judge(without <= all && without >= 0.6 * all),
            ];
        },
    },
    {
        paper: "Without delaying non-conflicting insertions performance deteriorates across almost all examples.",
        rule: "More work than all features on at least 80 % of the instances.",
        of: (data) => {
            const slower = data.instances.filter(
                ({ results }) => results[2].work > results[0].work,
            );
            return [
                `more work on ${slower.length} of ${data.instances.length}; ${provedOf(data, 2)} against ${provedOf(data, 0)} proved`,
                judge(slower.length >= 0.8 * data.instances.length),
            ];
        },
    },
    ...[
        ["With best-first priority", 3],
        ["With bounds that ignore candidate paths", 4],
    ].map(([feature, variant]) => ({
        paper: `${feature} only very few runs terminate.`,
        rule: "Proves at most half of what all features prove.",
        of: (data) => {
            const [all, without] = [0, variant].map((i) => provedOf(data, i));
            return [`${without} against ${all} proved`, judge(without <= all / 2)];
        },
    })),
];

export function claims(data) {
    return claimsOf("5.1", claimed, data);
}
