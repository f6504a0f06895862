// The methods that are compared, and how the report shows them.
import { colours } from "./report/plot.mjs";

export const heuristics = ["praun", "kraevoy", "schreiner"];
export const algorithms = [...heuristics, "branch-and-bound", "exact"];
export const names = {
    praun: "[PSS01]",
    kraevoy: "[KSG03]",
    schreiner: "[SAPH04]",
    "branch-and-bound": "branch and bound",
    exact: "exact",
};
export const colourOf = { ...colours, "branch-and-bound": colours.branchAndBound };
/** The paper's tolerance. */
export const tolerance = 0.01;

export const finite = (cost) => cost ?? Infinity;

/** How much longer than the best the longest embedding of a heuristic is; failures count as none. */
export function worstExcess({ records }) {
    const costs = heuristics.map((algorithm) => records[algorithm].cost ?? 0);
    return Math.max(...costs) / finite(records.exact.cost);
}
