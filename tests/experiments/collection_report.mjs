// The report on the classes of shapes (collection.mjs).
import {
    algorithms,
    colourOf,
    finite,
    heuristics,
    names,
    tolerance,
    worstExcess,
} from "./methods.mjs";
import { cumulative, secondsToBest, secondsToGap, shareWithin } from "./histories.mjs";
import { claimsOf, judge } from "./report/claims.mjs";
import { colours, legend, plot } from "./report/plot.mjs";
import {
    count,
    escape,
    figure,
    findings,
    number,
    percent,
    picture,
    pictures,
    seconds,
    table,
} from "./report/html.mjs";

const isInScope = ({ genus }) => genus === 0;

/** What is counted over instances, for the text, the table and the claims. */
function statistics(instances) {
    const records = (algorithm) => instances.map((instance) => instance.records[algorithm]);
    const bestOf = ({ records: all }) =>
        Math.min(...algorithms.map((algorithm) => finite(all[algorithm].cost)));
    const within = (algorithm, factor) =>
        instances.filter(
            (instance) => finite(instance.records[algorithm].cost) <= factor * bestOf(instance),
        ).length;
    const allAgree = (instance) =>
        heuristics.every(
            (algorithm) =>
                finite(instance.records[algorithm].cost) <= (1 + tolerance) * bestOf(instance),
        );
    const bestHeuristic = (instance) =>
        Math.min(...heuristics.map((algorithm) => finite(instance.records[algorithm].cost)));
    return {
        total: instances.length,
        records,
        within,
        allAgree: instances.filter(allAgree).length,
        allFail: instances.filter(
            (instance) => bestHeuristic(instance) > (1 + tolerance) * bestOf(instance),
        ).length,
        worst: Math.max(...instances.map(worstExcess)),
        provedTo: (algorithm, gap) =>
            records(algorithm).filter((record) => record.cost !== null && record.gap <= gap).length,
        largestGap: (algorithm) => Math.max(...records(algorithm).map(({ gap }) => gap)),
        bestTimes: (algorithm) => records(algorithm).map(secondsToBest),
        gapTimes: (algorithm, gap) => records(algorithm).map((record) => secondsToGap(record, gap)),
        longest: (algorithm) => Math.max(...records(algorithm).map(({ cpuSearch }) => cpuSearch)),
        quicklyProved: instances.filter(
            (instance) =>
                allAgree(instance) && secondsToGap(instance.records.exact, tolerance) <= 10,
        ).length,
        notWorse: instances.filter(
            (instance) =>
                finite(instance.records["branch-and-bound"].cost) <=
                bestHeuristic(instance) * (1 + 1e-12),
        ).length,
    };
}

export function section(data) {
    const closed = data.instances.filter(isInScope);
    const all = statistics(data.instances);
    const s = statistics(closed);
    const classes = groupBy(data.instances, ({ shown }) => shown);
    return [
        findings(
            "SHREC’07, 16 classes of genus 0, the layout of each class from its first model, five minutes per instance. In some classes all methods do equally well; in most instances branch and bound gives shorter embeddings than the greedy methods, whose failures show as swirls; all three fail in plenty of cases. 35 % are proved optimal to 1 %, 83 % to 5 %; the largest gaps named are 10 % and 17 %. In 60 % the best solution is found within 10 s.",
            `${data.instances.length} instances in ${classes.size} classes, at most ${data.limit / 1e6} million units of work (${seconds(all.longest("branch-and-bound"))} CPU at most for branch and bound, ${seconds(all.longest("exact"))} for the exact method). On the ${s.total} of genus 0 all three heuristics are within 1 % of the best embedding in ${percent(s.allAgree / s.total)}, and all three fail in ${percent(s.allFail / s.total)}; the longest is ${number(s.worst)} times the best. Branch and bound proves ${percent(s.provedTo("branch-and-bound", 0.01) / s.total)} to 1 %, the exact method ${percent(s.provedTo("exact", 0) / s.total)} to gap 0.`,
        ),
        lengthPlots(classes),
        timePlots(closed),
        swirls(data.drawn),
        summaryTable(classes),
    ].join("");
}

function groupBy(list, key) {
    const groups = new Map();
    for (const item of list) {
        groups.set(key(item), [...(groups.get(key(item)) ?? []), item]);
    }
    return groups;
}

function lengthPlots(classes) {
    const marksOf = (instances) => {
        const relative = (algorithm, field) =>
            instances.map(({ records }, i) => [
                i,
                (records[algorithm][field] ?? NaN) / records.exact.cost,
            ]);
        return [
            {
                type: "ticks",
                data: relative("branch-and-bound", "lowerBound"),
                colour: colours.branchAndBoundBound,
                name: "lower bound, branch and bound",
            },
            {
                type: "ticks",
                data: relative("exact", "lowerBound"),
                colour: colours.bound,
                name: "lower bound, exact",
            },
            ...algorithms.map((algorithm) => ({
                type: "points",
                data: relative(algorithm, "cost").filter(([, y]) => Number.isFinite(y)),
                colour: colourOf[algorithm],
                name: names[algorithm],
                size: algorithm === "exact" ? 3 : 4.5,
            })),
        ];
    };
    const panels = [...classes].map(([shown, instances]) => {
        const costs = instances.flatMap(({ records }) =>
            algorithms.map((algorithm) => (records[algorithm].cost ?? 0) / records.exact.cost),
        );
        return plot({
            width: 320,
            height: 210,
            label: `Relative lengths in the class ${shown}`,
            x: { label: shown, from: -0.5, to: instances.length - 0.5 },
            y: {
                label: "length / exact",
                from: 0.9,
                to: Math.max(1.1, 1.02 * Math.max(...costs)),
            },
            marks: marksOf(instances).map((mark) => ({ ...mark, name: undefined })),
            names: instances.map((_, i) => String(i + 1)),
        });
    });
    return figure(
        `<div class="multiples">${panels.join("")}</div>${legend(marksOf([]).map((mark) => ({ ...mark, type: mark.type === "ticks" ? "line" : "points" })))}`,
        "Total lengths per class (Fig. 10), relative to the exact method’s embedding; a column per instance. A heuristic that ends without an embedding has no dot. Bounds of branch and bound hold for insertion sequences.",
    );
}

function timePlots(instances) {
    const s = statistics(instances);
    const [begin, end] = [0.01, 400];
    const steps = (times, colour, name, dashed = false) => ({
        type: "steps",
        data: cumulative(times, begin, end),
        colour,
        name,
        dashed,
    });
    const axis = {
        x: { label: "CPU seconds (logarithmic)", log: true, from: begin, to: end },
        y: { label: "share of instances", from: 0, to: 1, format: (y) => percent(y) },
    };
    const paperPoint = (data, name) => ({
        type: "points",
        data,
        colour: colours.schreiner,
        name,
        size: 6,
    });
    return [
        figure(
            plot({
                label: "Share of instances whose best embedding was found, over time",
                ...axis,
                marks: [
                    steps(
                        s.bestTimes("branch-and-bound"),
                        colours.branchAndBound,
                        "branch and bound",
                    ),
                    steps(s.bestTimes("exact"), colours.exact, "exact"),
                    paperPoint(
                        [
                            [10, 0.6],
                            [180, 0.98],
                        ],
                        "the paper",
                    ),
                ],
            }),
            `Time to the best embedding that a search ends with, ${count(instances.length, "instance")} of genus 0.`,
        ),
        figure(
            plot({
                label: "Share of instances proved, over time",
                ...axis,
                marks: [
                    steps(
                        s.gapTimes("branch-and-bound", 0.01),
                        colours.branchAndBound,
                        "branch and bound, to 1 %",
                    ),
                    steps(
                        s.gapTimes("branch-and-bound", 0.05),
                        colours.branchAndBound,
                        "branch and bound, to 5 %",
                        true,
                    ),
                    steps(s.gapTimes("exact", 0), colours.bound, "exact, to gap 0"),
                    steps(s.gapTimes("exact", 0.01), colours.exact, "exact, to 1 %"),
                    paperPoint(
                        [
                            [300, 0.35],
                            [300, 0.83],
                        ],
                        "the paper: 1 % and 5 % in five minutes",
                    ),
                ],
            }),
            "Share of instances proved over time. What branch and bound proves holds among insertion sequences, what the exact method proves among all embeddings.",
        ),
    ].join("");
}

function swirls(drawn) {
    const rows = drawn.map(({ shown, source, target, drawings }) => {
        const cells = drawings.map(({ algorithm, ratio, detours, picture: file }) =>
            file === null
                ? `<figure class="picture"><figcaption>${escape(names[algorithm])}: no embedding</figcaption></figure>`
                : picture(
                      file,
                      algorithm === "exact"
                          ? "exact"
                          : `${names[algorithm]}: ${number(ratio)} times as long${detours > 0 ? `, ${count(detours, "detour")}` : ""}`,
                      `${shown}, ${target}, ${names[algorithm]}`,
                  ),
        );
        return `<h3>${escape(shown)}: the layout of “${escape(source)}” in “${escape(target)}”</h3>${pictures(cells)}`;
    });
    return `${rows.join("")}<p class="note">The classes where a heuristic ends farthest above the best embedding (Fig. 11), seen from where its detours show best. Red: layout edges that cost more than 1.25 times what they cost in the exact method’s embedding, and the same edges there.</p>`;
}

function summaryTable(classes) {
    const slowest = Math.max(
        ...[...classes.values()]
            .flat()
            .flatMap(({ records }) => heuristics.map((algorithm) => records[algorithm].cpuSearch)),
    );
    const rows = [...classes].map(([shown, instances]) => {
        const s = statistics(instances);
        const { genus, boundaryLoops } = instances[0];
        return [
            shown,
            `${genus}${boundaryLoops > 0 ? ", boundary" : ""}`,
            instances.length,
            instances[0].layoutEdges,
            ...heuristics.map((algorithm) => s.within(algorithm, 1 + tolerance)),
            s.within("branch-and-bound", 1 + tolerance),
            s.provedTo("branch-and-bound", 0.01),
            s.provedTo("exact", 0.01),
            s.provedTo("exact", 0),
            seconds(s.longest("branch-and-bound")),
            seconds(s.longest("exact")),
        ];
    });
    return table(
        [
            "class",
            "genus",
            "instances",
            "edges",
            ...heuristics.map((name) => `${names[name]} within 1 %`),
            "B&B within 1 %",
            "B&B proved 1 %",
            "exact proved 1 %",
            "exact proved 0",
            "longest B&B",
            "longest exact",
        ],
        rows,
        `“Within 1 %” counts embeddings at most 1 % longer than the best one known. The heuristics take at most ${seconds(slowest)}.`,
    );
}

const claimed = [
    {
        paper: "In some classes all methods find the same embedding.",
        rule: "In at least one instance of genus 0 all three heuristics are within 1 % of the best.",
        of: ({ s }) => [share(s, s.allAgree), judge(s.allAgree > 0)],
    },
    {
        paper: "In favorable cases the greedy embedding is quickly proved to be optimal to 1 %.",
        rule: "Where all three heuristics are within 1 % of the best, the exact method proves 1 % within 10 CPU seconds.",
        of: ({ s }) => [
            `${s.quicklyProved} of ${s.allAgree}`,
            judge(s.quicklyProved === s.allAgree),
        ],
    },
    {
        paper: "In most instances branch and bound achieves considerable improvements.",
        rule: "In more than half of the instances of genus 0 some heuristic ends more than 1 % above the best.",
        of: ({ s }) => [share(s, s.total - s.allAgree), judge(s.total - s.allAgree > s.total / 2)],
    },
    {
        paper: "Each greedy method fails in a significant number of instances.",
        rule: "Each heuristic is more than 1 % above the best in at least 10 % of the instances of genus 0.",
        of: ({ s }) => {
            const failures = heuristics.map(
                (algorithm) => 1 - s.within(algorithm, 1 + tolerance) / s.total,
            );
            return [
                failures.map((failure) => percent(failure)).join(", "),
                judge(Math.min(...failures) >= 0.1),
            ];
        },
    },
    {
        paper: "There are plenty of cases in which all three greedy methods fail.",
        rule: "All three are more than 1 % above the best in at least 10 % of the instances of genus 0.",
        of: ({ s }) => [share(s, s.allFail), judge(s.allFail >= 0.1 * s.total)],
    },
    {
        paper: "The embeddings of branch and bound are always shorter than or equal to those of the greedy methods.",
        rule: "Branch and bound is never above the shortest of the three.",
        of: ({ all }) => [`${all.notWorse} of ${all.total}`, judge(all.notWorse === all.total)],
    },
    {
        paper: "No swirls or unnecessarily long paths in the embeddings of branch and bound.",
        rule: "Every one is at most 1 % longer than the best embedding known (genus 0). Passed if the exact method proves all of its own to 1 %.",
        of: ({ s }) => {
            const within = s.within("branch-and-bound", 1 + tolerance);
            const proved = s.provedTo("exact", 0.01);
            return [
                `${within} of ${s.total} within 1 %; exact: ${proved} proved to 1 %`,
                judge(within === s.total, proved === s.total),
            ];
        },
    },
    provedClaim("35 %", 0.35, 0.01),
    provedClaim("83 %", 0.83, 0.05),
    {
        paper: "Only in a few cases a large gap remains (10 % and 17 % are named).",
        rule: "The exact method’s largest gap is at most 17 % (genus 0); passed if at most 10 %.",
        of: ({ s }) => {
            const gap = s.largestGap("exact");
            return [
                `${percent(gap, 1)}; branch and bound ${percent(s.largestGap("branch-and-bound"), 1)}`,
                judge(gap <= 0.17, gap <= 0.1),
            ];
        },
    },
    {
        paper: "In 60 % the best solution is found after 10 s.",
        rule: "Share of best solutions of the exact method found within 10 CPU seconds (genus 0); confirmed from 60 %, passed above.",
        of: ({ s }) => {
            const early = shareWithin(s.bestTimes("exact"), 10);
            return [percent(early), judge(early >= 0.6, early > 0.6)];
        },
    },
    {
        paper: "In 2 % only the final result came after more than three minutes.",
        rule: "At most 2 % of the exact method’s best solutions after more than 180 CPU seconds (genus 0); passed if none.",
        of: ({ s }) => {
            const late = 1 - shareWithin(s.bestTimes("exact"), 180);
            return [percent(late), judge(late <= 0.02, late === 0)];
        },
    },
    {
        section: "6",
        paper: "The method is limited to simply-connected targets; elsewhere embeddings need not be cellular.",
        rule: "Passed if the exact method embeds every instance of genus 1 to 3, which the checker confirms to be cellular.",
        of: ({ higher }) => {
            const embedded = higher.filter(({ records }) => records.exact.cost !== null).length;
            return [
                `${embedded} of ${higher.length} embedded, ${statistics(higher).provedTo("exact", 0.01)} proved to 1 %`,
                judge(embedded === higher.length, true),
            ];
        },
    },
];

function provedClaim(text, wanted, gap) {
    return {
        paper: `${text} are proved optimal to ${percent(gap)} within five minutes.`,
        rule: `Share proved to ${percent(gap)} by the exact method, genus 0; confirmed from ${text}, passed above.`,
        of: ({ s }) => {
            const proved = s.provedTo("exact", gap) / s.total;
            return [
                `${percent(proved)}; branch and bound ${share(s, s.provedTo("branch-and-bound", gap))}`,
                judge(proved >= wanted, proved > wanted),
            ];
        },
    };
}

const share = (s, n) => percent(n / s.total);

export function claims(data) {
    return claimsOf(
        "5.1",
        claimed,
        data && {
            s: statistics(data.instances.filter(isInScope)),
            all: statistics(data.instances),
            higher: data.instances.filter(({ genus }) => genus > 0),
        },
    );
}
