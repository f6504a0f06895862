// Layout boundary edges along the target's boundary, from the command line to the check.
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import type { EmbeddingDocument } from "layout-embedding";
import { expect, test } from "vitest";
import { inFolder, run } from "./command.js";

/** A square whose sides are bent outwards, in 2 n^2 triangles; vertex (x, y) is x + y (n + 1). */
function roundSquare(n: number): string {
    const lines: string[] = [];
    const bend = (t: number) => 0.3 * (1 - t * t);
    for (let y = 0; y <= n; ++y) {
        for (let x = 0; x <= n; ++x) {
            const [u, v] = [(2 * x) / n - 1, (2 * y) / n - 1];
            lines.push(`v ${String(u * (1 + bend(v)))} ${String(v * (1 + bend(u)))} 0`);
        }
    }
    for (let y = 0; y < n; ++y) {
        for (let x = 0; x < n; ++x) {
            const [a, b, c, d] = [0, 1, n + 2, n + 1].map((k) => String(x + y * (n + 1) + k + 1));
            lines.push(`f ${a!} ${b!} ${c!}`, `f ${a!} ${c!} ${d!}`);
        }
    }
    return lines.join("\n") + "\n";
}

test("edges_run_along_the_boundary_on_demand", () =>
    inFolder(async (cwd) => {
        const n = 12;
        writeFileSync(path.join(cwd, "target.obj"), roundSquare(n));
        writeFileSync(
            path.join(cwd, "layout.obj"),
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n",
        );
        writeFileSync(
            path.join(cwd, "landmarks.txt"),
            [0, n, (n + 1) * (n + 1) - 1, n * (n + 1)].join("\n") + "\n",
        );
        const inputs = ["layout.obj", "target.obj", "--landmarks", "landmarks.txt"];
        const embed = async (output: string, ...options: string[]) => {
            const finished = await run(["embed", ...inputs, "--output", output, ...options], {
                cwd,
            });
            expect(finished.exitCode).toBe(0);
            return JSON.parse(
                readFileSync(path.join(cwd, output, "embedding.json"), "utf8"),
            ) as EmbeddingDocument;
        };
        const isOnBoundary = (v: number) =>
            [0, n].includes(v % (n + 1)) || [0, n].includes(Math.floor(v / (n + 1)));
        const following = (document: EmbeddingDocument) =>
            document.edges.filter(({ chain }) => chain.every(isOnBoundary)).length;
        const free = await embed("free", "--gap", "0");
        const bound = await embed("bound", "--gap", "0", "--boundary-edges", "follow");
        expect(following(free)).toBe(0);
        expect(following(bound)).toBe(4);
        expect(bound.boundaryEdges).toBe("follow");
        expect(bound.status).toBe("optimal");
        expect(bound.cost).toBeGreaterThan(free.cost!);
        const check = await run(["check", "bound", ...inputs], { cwd });
        expect(check.exitCode).toBe(0);
        for (const wrong of [
            ["--boundary-edges", "follow", "--algorithm", "greedy"],
            ["--boundary-edges", "always"],
        ]) {
            const refused = await run(["embed", ...inputs, ...wrong, "--json"], { cwd });
            expect(refused.exitCode).toBe(2);
            expect(refused.stdout).toContain("invalidOption");
        }
    }));
