// Two of the experiments as `npm run experiments -- --quick` makes them, and their report.
import { readFileSync } from "node:fs";
import path from "node:path";
import { expect, test } from "vitest";
import { inFolder, runProgram } from "./command.js";

const program = path.resolve(import.meta.dirname, "../experiments/experiments.mjs");

interface WalkState {
    distance: number;
    kept: number | null;
    costs: Record<string, { cost: number | null; gap: number; same: boolean }>;
}

interface Results {
    experiments: {
        disks: { data: { cases: { cost: number | null; lowerBound: number; gap: number }[] } };
        walk: { data: { walks: { states: WalkState[] }[] } };
    };
}

test("an experiment's numbers are in the report, which needs nothing else", async () => {
    await inFolder(async (folder) => {
        const only = ["disks", "walk"].flatMap((name) => ["--only", name]);
        const { exitCode, stderr } = await runProgram(process.execPath, [
            ...[program, "--quick", ...only, "--output", folder],
        ]);
        expect(stderr).toBe("");
        expect(exitCode).toBe(0);
        const results = JSON.parse(
            readFileSync(path.join(folder, "results.json"), "utf8"),
        ) as Results;
        const html = readFileSync(path.join(folder, "report.html"), "utf8");

        const { cases } = results.experiments.disks.data;
        expect(cases).toHaveLength(8);
        for (const { cost, lowerBound, gap } of cases) {
            expect(lowerBound).toBeLessThanOrEqual((cost ?? 0) * (1 + 1e-12));
            expect(gap).toBe(0);
            expect(html).toContain(`<td class="number">${(cost ?? 0).toFixed(2)}</td>`);
        }
        const states = results.experiments.walk.data.walks.flatMap((walk) => walk.states);
        expect(states[0]?.costs["exact"]?.same).toBe(true);
        for (const { kept, costs } of states) {
            // The class that was carried along has an embedding, which is no shorter than the best.
            expect(costs["exact"]?.gap).toBe(0);
            expect(kept).toBeGreaterThanOrEqual((costs["exact"]?.cost ?? Infinity) * (1 - 1e-12));
        }

        // No script, and every address is a place in the page or a picture in it.
        expect(html).not.toMatch(/<script|<link|@import/);
        const addresses = [...html.matchAll(/(?:src|href)="([^"]*)"|url\(([^)]*)\)/g)].map(
            ([, attribute, style]) => attribute ?? style ?? "",
        );
        expect(
            addresses.filter((address) => address.startsWith("data:image/png;base64,")),
        ).toHaveLength(8 + 3);
        for (const address of addresses) {
            expect(address).toMatch(/^(#|data:image\/png;base64,)/);
        }
    });
});

test("an unknown experiment is refused with the names that there are", async () => {
    const { exitCode, stderr } = await runProgram(process.execPath, [program, "--only", "none"]);
    expect(exitCode).toBe(1);
    expect(stderr).toContain("there is no experiment none; --only takes order, ");
});
