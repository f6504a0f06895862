// The report: one HTML file without anything from elsewhere.
import { writeFileSync } from "node:fs";
import path from "node:path";
import { experiments } from "../list.mjs";
import { claimsInBrief, claimsTable, judgedClaims } from "./claims.mjs";
import { escape, setReportFolder, table } from "./html.mjs";
import { style } from "./style.mjs";

/** Writes the report of a run into the folder that has its pictures; returns the file. */
export function writeReport(folder, run) {
    setReportFolder(folder);
    const done = experiments.filter(({ name }) => run.experiments[name] !== undefined);
    const claims = judgedClaims(experiments, run.experiments);
    const sections = done.map(({ name, experiment }) => {
        const { data, cpuSeconds } = run.experiments[name];
        return `<section id="${name}"><h2>${escape(experiment.title)}</h2>${experiment.section(data)}<p class="note">CPU time of this experiment: ${cpuSeconds.toFixed(0)} s.</p></section>`;
    });
    const contents = [
        ...done.map(({ name, experiment }) => [name, experiment.title]),
        ["claims", "The paper’s claims"],
    ].map(([name, title]) => `<li><a href="#${name}">${escape(title)}</a></li>`);
    const html = `<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>Layout embedding: experiments</title><style>${style}</style></head><body><main>
<h1>Layout embedding: the paper’s experiments, and ours</h1>
${introduction(run, claims)}
<nav aria-label="Contents"><ol>${contents.join("")}</ol></nav>
${sections.join("\n")}
<section id="claims"><h2>The paper’s claims</h2>${claimsTable(claims)}</section>
</main></body></html>
`;
    const file = path.join(folder, "report.html");
    writeFileSync(file, html);
    return file;
}

function introduction({ date, quick, machine, seconds, cpuSeconds, embeddings }, claims) {
    return `<p class="lead">The experiments of <i>Layout Embedding via Combinatorial Optimization</i> (Computer Graphics Forum, 2021; “the paper”) made again with this project’s solver on this project’s own shapes, and some that the paper does not have. Each section says what the paper found and what this run found. Every number of ours was measured in this run; numbers of the paper are quoted from its text. ${claimsInBrief(claims)} See <a href="#claims">the table at the end</a>.</p>
<p>Targets and landmarks are not the paper’s (its SHREC’07 models may not be shipped), so numbers are to be compared in kind and not digit by digit. Searches run in the npm package, that is in WebAssembly in Node, one thread per instance; what the package does not offer (parts of searches switched off, all orders of insertion, geodesics) comes from native programs. Searches end at limits in units of work (about one node expansion each), so costs and bounds are the same on every machine. Times are CPU seconds, since other programs may run beside; pictures show paths straightened within their homotopy classes. Costs and bounds are lengths in the path graph, see <a href="#metric">the section on the metric</a>. Each of the ${embeddings} embeddings that the package made in this run was confirmed by a checker that shares no code with the search.</p>
${table(
    ["run", "machine", "duration", "CPU time"],
    [
        [
            `${date.slice(0, 16).replace("T", " ")} UTC, ${quick ? "quick: fewer and smaller instances" : "all experiments"}`,
            `${machine.processor}, ${machine.cores} cores, Node ${machine.node}, ${machine.platform}`,
            `${(seconds / 60).toFixed(1)} min`,
            `${(cpuSeconds / 60).toFixed(1)} min`,
        ],
    ],
)}`;
}
