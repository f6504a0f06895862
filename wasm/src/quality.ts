// A report on an embedding's paths and patches, read out of the core.
import type { Core, Handle } from "./core.js";
import type { QualityReport } from "./types.js";

/** Makes the report on a job's embedding, of a layout with so many edges. */
export function qualityReport(core: Core, job: Handle, edgeCount: number): QualityReport {
    core.call("boundary_job_edge_costs", job);
    const costs = core.viewedDoubles();
    core.call("boundary_job_even_lengths", job);
    const evenLengths = core.viewedDoubles();
    core.call("boundary_job_quality", job);
    const numbers = core.viewedDoubles();
    const edges = Array.from({ length: edgeCount }, (_, id) => {
        const [length = 0, turning = 0] = numbers.subarray(2 * id, 2 * id + 2);
        return { id, cost: costs[id] ?? 0, evenLength: evenLengths[id] ?? 0, length, turning };
    });
    const ofPatches = numbers.subarray(2 * edgeCount);
    const patches = Array.from({ length: ofPatches.length / 4 }, (_, face) => {
        const [area = 0, perimeter = 0, isoperimetricQuotient = 0, stretch = Infinity] =
            ofPatches.subarray(4 * face, 4 * face + 4);
        return {
            face,
            area,
            perimeter,
            isoperimetricQuotient,
            stretch: Number.isFinite(stretch) ? stretch : null,
        };
    });
    const sum = (values: number[]) => values.reduce((total, value) => total + value, 0);
    const quotients = patches.map((patch) => patch.isoperimetricQuotient);
    const stretches = patches.map((patch) => patch.stretch);
    const known = stretches.filter((stretch) => stretch !== null);
    return {
        edges,
        patches,
        overall: {
            cost: sum(edges.map((edge) => edge.cost)),
            evenLength: sum(edges.map((edge) => edge.evenLength)),
            length: sum(edges.map((edge) => edge.length)),
            turning: sum(edges.map((edge) => edge.turning)),
            area: sum(patches.map((patch) => patch.area)),
            leastQuotient: Math.min(...quotients),
            meanQuotient: sum(quotients) / quotients.length,
            largestStretch: known.length < stretches.length ? null : Math.max(...known),
        },
    };
}
