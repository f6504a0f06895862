// The main job on real and named instances, end to end: embed, read back, check.
import { readFileSync } from "node:fs";
import path from "node:path";
import type { EmbeddingDocument } from "layout-embedding";
import { describe, expect, test } from "vitest";
import { inFolder, run } from "./command.js";
import { controlMeshes, hasShared, sphereCubes } from "./data.js";

describe.skipIf(!hasShared)("embed", () => {
    test.each([...controlMeshes, ...sphereCubes])(
        "all_edges_are_embedded_and_check_accepts: $name",
        ({ layout, target, landmarks }) =>
            inFolder(async (folder) => {
                const output = path.join(folder, "out");
                const given = landmarks === null ? [] : ["--landmarks", landmarks];
                const args = ["embed", layout, target, ...given, "--output", output, "--json"];
                const finished = await run(args);
                expect(finished).toMatchObject({ exitCode: 0, stderr: "" });
                const document = JSON.parse(
                    readFileSync(path.join(output, "embedding.json"), "utf8"),
                ) as EmbeddingDocument;
                expect(["optimal", "gapReached", "feasible", "workLimit"]).toContain(
                    document.status,
                );
                expect(document.gap).toBeCloseTo(
                    (document.cost! - document.lowerBound!) / document.cost!,
                    9,
                );
                const check = await run(["check", output, layout, target, ...given, "--json"]);
                expect(JSON.parse(check.stdout)).toEqual({
                    valid: true,
                    violations: [],
                    edges: document.edges.length,
                    cost: document.cost,
                });
                expect(check.exitCode).toBe(0);
            }),
    );
});
