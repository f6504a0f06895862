// What the paper's Section 5 claims, judged by the numbers of the run: experiments list their claims with
// a rule, the value that it is applied to, and its verdict.
import { escape } from "./html.mjs";

const verdicts = {
    confirmed: "confirmed",
    passed: "passed",
    missed: "not reached",
    open: "not tried",
};

/**
 * The claims of all experiments by section: { name, section, paper, rule, found, verdict }, all but name
 * and verdict HTML. `confirmed`: found as the paper has it; `passed`: better; `missed`: not reached;
 * `open`: not tried in this run.
 */
export function judgedClaims(experiments, results) {
    return experiments
        .filter(({ experiment }) => experiment.claims !== undefined)
        .flatMap(({ name, experiment }) => {
            const claims = experiment.claims(results[name]?.data ?? null);
            return claims.map((claim) => ({ ...claim, name }));
        })
        .sort((a, b) => a.section.localeCompare(b.section, "en", { numeric: true }));
}

/** How many claims got each verdict, as a sentence. */
export function claimsInBrief(claims) {
    const counts = Object.keys(verdicts).map((verdict) => ({
        verdict,
        count: claims.filter((claim) => claim.verdict === verdict).length,
    }));
    const parts = counts
        .filter(({ count }) => count > 0)
        .map(({ verdict, count }) => `<b class="${verdict}">${count} ${verdicts[verdict]}</b>`);
    return `Of ${claims.length} claims of the paper: ${parts.join(", ")}.`;
}

export function claimsTable(rows) {
    const body = rows.map(
        ({ section, paper, rule, found, verdict, name }) =>
            `<tr><td>${escape(section)}</td><td>${paper}</td><td>${rule}</td><td>${verdict === "open" ? "" : `${found} <a href="#${name}" aria-label="the experiment">↑</a>`}</td><td class="verdict ${verdict}">${verdicts[verdict]}</td></tr>`,
    );
    return `<p>Verdicts follow from the run’s numbers by the rule in the third column. <i>Confirmed</i>: as the paper has it. <i>Passed</i>: the rule holds, with a better value than the paper’s. <i>Not reached</i>: the rule fails, so this run does not show it.</p><div class="wide"><table><thead><tr><th>Section</th><th>The paper’s claim</th><th>Rule</th><th>This run</th><th>Verdict</th></tr></thead><tbody>${body.join("")}</tbody></table></div>`;
}

/**
 * The claims of an experiment: { paper, rule, of, section }, where `of` makes [found, verdict] of the
 * experiment's data. Without data they are open.
 */
export function claimsOf(section, entries, data) {
    return entries.map(({ of, ...claim }) => {
        const [found, verdict] = data === null ? ["", "open"] : of(data);
        return { section, ...claim, found, verdict };
    });
}

/** A claim's verdict: `passed` where `better`, else `confirmed` or `missed`. */
export function judge(holds, better = false) {
    return !holds ? "missed" : better ? "passed" : "confirmed";
}
