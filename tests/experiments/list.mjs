// The experiments in the order of the report.
import * as collection from "./collection.mjs";
import * as timeline from "./timeline.mjs";

export const experiments = [
    { name: "timeline", experiment: timeline },
    { name: "collection", experiment: collection },
];
