// What can be read off the course of a search: records of solveAndRecord() in solving.mjs.

/** CPU seconds until (cost - lower bound) / cost was at most `gap`; Infinity if it never was. */
export function secondsToGap(record, gap) {
    const event = record.history.find(
        ({ cost, lowerBound }) => cost !== null && cost - lowerBound <= gap * cost * (1 + 1e-12),
    );
    if (event !== undefined) {
        return event.cpu;
    }
    return record.cost !== null && record.gap <= gap ? record.cpuSearch : Infinity;
}

/** CPU seconds until the best embedding was found; Infinity if none was. */
export function secondsToBest(record) {
    return record.cpuBest ?? Infinity;
}

/** The share of records whose time is at most `seconds`. */
export function shareWithin(times, seconds) {
    return times.filter((time) => time <= seconds).length / times.length;
}

/** The share of times reached as a function of time: points for a plot in steps, up to `end`. */
export function cumulative(times, begin, end) {
    const sorted = times.filter(Number.isFinite).sort((a, b) => a - b);
    const points = [[begin, 0]];
    sorted.forEach((time, i) => points.push([Math.max(time, begin), (i + 1) / times.length]));
    points.push([end, sorted.length / times.length]);
    return points;
}

/** Costs and lower bounds over CPU seconds, for plots in steps. */
export function boundsOverTime(record, begin) {
    const rows = [...record.history].map((event) => ({
        ...event,
        cpu: Math.max(begin, event.cpu),
    }));
    rows.push({
        cpu: Math.max(begin, record.cpuSearch),
        cost: record.cost,
        lowerBound: record.lowerBound,
    });
    return {
        costs: rows.filter(({ cost }) => cost !== null).map(({ cpu, cost }) => [cpu, cost]),
        bounds: rows
            .filter(({ lowerBound }) => lowerBound > 0)
            .map(({ cpu, lowerBound }) => [cpu, lowerBound]),
    };
}
