// The experiments in the order of the report.
import * as ablation from "./ablation.mjs";
import * as collection from "./collection.mjs";
import * as counterexample from "./counterexample.mjs";
import * as disks from "./disks.mjs";
import * as growth from "./growth.mjs";
import * as maps from "./maps.mjs";
import * as metric from "./metric.mjs";
import * as order from "./order.mjs";
import * as parts from "./parts.mjs";
import * as quads from "./quads.mjs";
import * as timeline from "./timeline.mjs";
import * as walk from "./walk.mjs";

export const experiments = [
    { name: "order", experiment: order },
    { name: "counterexample", experiment: counterexample },
    { name: "timeline", experiment: timeline },
    { name: "collection", experiment: collection },
    { name: "ablation", experiment: ablation },
    { name: "walk", experiment: walk },
    { name: "quads", experiment: quads },
    { name: "maps", experiment: maps },
    { name: "disks", experiment: disks },
    { name: "metric", experiment: metric },
    { name: "growth", experiment: growth },
    { name: "parts", experiment: parts },
];
