// The TypeScript API in the calling thread, on meshes made by code.
import { embed, errorInfos, LayoutError, Session, type EmbedProgress } from "layout-embedding";
import { describe, expect, test } from "vitest";
import { arrays, cube, displacedLandmarks, file, octahedron, sphere } from "./meshes.js";

const problem = { layout: arrays(octahedron), target: arrays(sphere(3)) };

describe("an embedding", () => {
    test("has_one_chain_per_layout_edge_from_landmark_to_landmark", async () => {
        const landmarks = displacedLandmarks;
        const result = await embed({ ...problem, landmarks });
        expect(result.edges).toHaveLength(12);
        for (const edge of result.edges) {
            const [start, end] = edge.layoutEdge;
            expect(edge.chain[0]).toBe(landmarks[start]);
            expect(edge.chain.at(-1)).toBe(landmarks[end]);
            expect(edge.weakPath[0]).toEqual([landmarks[start]]);
            expect(edge.weakPath.at(-1)).toEqual([landmarks[end]]);
        }
        expect(Array.from(result.insertionOrder).sort((a, b) => a - b)).toEqual(
            result.edges.map((edge) => edge.id),
        );
    });

    test("keeps_the_targets_vertices_and_covers_every_layout_face", async () => {
        const { refined } = await embed({ ...problem, landmarks: displacedLandmarks });
        const { positions } = problem.target;
        expect(refined?.positions.slice(0, positions.length)).toEqual(positions);
        expect(new Set(refined?.patches)).toEqual(new Set([0, 1, 2, 3, 4, 5, 6, 7]));
        expect(refined?.triangleFaces).toHaveLength((refined?.corners.length ?? 0) / 3);
        expect(refined?.vertexFaces).toHaveLength(
            ((refined?.positions.length ?? 0) - positions.length) / 3,
        );
    });

    test("costs_at_least_its_lower_bound_and_says_so_in_its_gap", async () => {
        const result = await embed({ ...problem, landmarks: displacedLandmarks });
        expect(result.cost).toBeGreaterThanOrEqual(result.lowerBound);
        expect(result.gap).toBeCloseTo((result.cost - result.lowerBound) / result.cost, 12);
        expect(result.exactCost! >= result.exactLowerBound).toBe(true);
    });

    test("of_paths_that_do_not_conflict_is_optimal", async () => {
        const result = await embed({ ...problem, landmarks: [0, 1, 2, 3, 4, 5] });
        expect(result.status).toBe("optimal");
        expect(result.gap).toBe(0);
        expect(result.exactCost).toBe(result.exactLowerBound);
    });

    test("gets_another_shape_without_a_new_search", async () => {
        const session = await Session.create();
        await expect(session.reshape("even")).rejects.toMatchObject({ code: "nothingToReshape" });
        await session.loadLayout(problem.layout);
        await session.loadTarget(problem.target);
        await session.setLandmarks(displacedLandmarks);
        const short = await session.solve();
        const even = await session.reshape("even");
        const total = (edges: { length: number }[]) =>
            edges.reduce((sum, { length }) => sum + length, 0);
        expect(even.status).toBe(short.status);
        expect(even.exactCost).toBe(short.exactCost);
        expect(total(short.edges)).toBeLessThan(total(even.edges));
        for (const [id, edge] of even.edges.entries()) {
            expect(edge.length).toBeCloseTo(edge.evenLength, 9);
            expect(short.edges[id]!.evenLength).toBe(edge.evenLength);
        }
        const shares = short.edges.reduce((sum, { cost }) => sum + cost, 0);
        expect(shares).toBeCloseTo(short.cost, 9);
        expect(short.quality!.smallestAngle).toBeGreaterThan(0);
        expect(short.quality!.smallestArea).toBeGreaterThan(0);
        expect(await session.check({ refined: even.refined!, edges: even.edges })).toEqual([]);
        const again = await session.reshape("short");
        expect(again.refined).toEqual(short.refined);
        await session.dispose();
    });

    test("takes_other_routes_or_keeps_them_as_asked_and_the_rest_follows", async () => {
        const session = await Session.create();
        await session.loadLayout(problem.layout);
        await session.loadTarget(problem.target);
        await session.setLandmarks(displacedLandmarks);
        const best = await session.solve({ gap: 0 });
        const disputed = best.edges[5]!;
        const avoid = { rule: "avoid", edge: 5, path: disputed.weakPath } as const;
        const other = await session.solve({ gap: 0, constraints: [avoid] });
        expect(other.status).toBe("optimal");
        expect(other.exactCost! > best.exactCost!).toBe(true);
        expect(other.edges[5]!.weakPath).not.toEqual(disputed.weakPath);
        expect(await session.check({ refined: other.refined!, edges: other.edges })).toEqual([]);
        expect(session.embeddingDocument().constraints).toEqual([avoid]);
        // Kept on its new route, the edge asks for just as much; on both, for what there is not.
        const keep = { rule: "keep", edge: 5, path: other.edges[5]!.weakPath } as const;
        const kept = await session.solve({ gap: 0, constraints: [keep] });
        expect(kept.exactCost).toBe(other.exactCost);
        const none = await session.solve({ constraints: [keep, { ...keep, rule: "avoid" }] });
        expect(none.status).toBe("infeasible");
        const refused = async (constraint: object, algorithm?: "greedy") =>
            session.solve({
                ...(algorithm === undefined ? {} : { algorithm }),
                constraints: [{ ...avoid, ...constraint }],
            });
        await expect(refused({ edge: 4 })).rejects.toMatchObject({ code: "invalidPath" });
        await expect(refused({ edge: 12 })).rejects.toMatchObject({ code: "invalidPath" });
        await expect(refused({ path: [[1, 2, 3, 4]] })).rejects.toMatchObject({
            code: "invalidPath",
        });
        await expect(refused({ path: [avoid.path[0]!, avoid.path.at(-1)!] })).rejects.toMatchObject(
            {
                code: "invalidPath",
            },
        );
        await expect(refused({ rule: "perhaps" })).rejects.toMatchObject({ code: "invalidOption" });
        await expect(refused({}, "greedy")).rejects.toMatchObject({ code: "invalidOption" });
        await session.dispose();
    });

    test.each(["greedy", "praun", "kraevoy", "schreiner"] as const)(
        "by_%s_is_complete_and_has_the_bound_of_the_root_state",
        async (algorithm) => {
            const plain = await embed(
                { ...problem, landmarks: displacedLandmarks },
                { algorithm: "greedy" },
            );
            const result = await embed(
                { ...problem, landmarks: displacedLandmarks },
                { algorithm },
            );
            expect(result.edges.every((edge) => edge.chain.length > 1)).toBe(true);
            expect(result.insertionOrder).toHaveLength(12);
            expect(result.exactLowerBound).toBe(plain.exactLowerBound);
            expect(result.exactCost! >= result.exactLowerBound).toBe(true);
            const best = await embed({ ...problem, landmarks: displacedLandmarks }, { gap: 0 });
            expect(best.exactCost! <= result.exactCost!).toBe(true);
            expect(best.exactLowerBound >= result.exactLowerBound).toBe(true);
        },
    );

    test("by_branch_and_bound_proves_the_best_insertion_sequence", async () => {
        const result = await embed(
            { ...problem, landmarks: displacedLandmarks },
            { gap: 0, algorithm: "branch-and-bound" },
        );
        expect(result.status).toBe("optimal");
        expect(result.exactCost).toBe(result.exactLowerBound);
        expect(result.boundScope).toBe("insertionSequences");
        expect(result.counters.statesExpanded).toBeGreaterThan(0);
        expect(result.counters.remembered).toBeGreaterThan(0);
        const costs = result.events.filter(({ kind }) => kind === "incumbent");
        expect(costs.length).toBeGreaterThan(0);
        expect(costs.at(-1)!.cost).toBe(result.cost);
    });

    test("by_default_proves_the_best_of_all_embeddings", async () => {
        const input = { ...problem, landmarks: displacedLandmarks };
        const result = await embed(input, { gap: 0 });
        expect(result.status).toBe("optimal");
        expect(result.exactCost).toBe(result.exactLowerBound);
        expect(result.boundScope).toBe("embeddings");
        const sequences = await embed(input, { gap: 0, algorithm: "branch-and-bound" });
        expect(result.exactCost! <= sequences.exactCost!).toBe(true);
    });

    test("without_landmarks_starts_from_proximity", async () => {
        const result = await embed(problem);
        expect(Array.from(result.landmarks)).toEqual([0, 1, 2, 3, 4, 5]);
    });

    test("is_the_same_from_files_and_from_arrays", async () => {
        const fromArrays = await embed({ ...problem, landmarks: displacedLandmarks });
        const fromFiles = await embed({
            layout: file(octahedron, "octahedron.obj"),
            target: file(sphere(3), "sphere.obj"),
            landmarks: { bytes: new TextEncoder().encode(displacedLandmarks.join("\n")) },
        });
        expect(fromFiles.exactCost).toBe(fromArrays.exactCost);
        expect(fromFiles.refined).toEqual(fromArrays.refined);
    });

    test("passes_the_checker_and_fails_it_with_another_chain", async () => {
        const session = await Session.create();
        await session.loadLayout(problem.layout);
        await session.loadTarget(problem.target);
        await session.setLandmarks(displacedLandmarks);
        const { refined, edges } = await session.solve();
        expect(await session.check({ refined: refined!, edges })).toEqual([]);
        const swapped = edges.map((edge, i) => ({ ...edge, chain: edges[i ^ 1]!.chain }));
        expect(await session.check({ refined: refined!, edges: swapped })).not.toEqual([]);
        await session.dispose();
    });
});

describe("a job", () => {
    test("reports_phases_and_paths_while_it_runs", async () => {
        const seen: EmbedProgress[] = [];
        await embed(
            { ...problem, landmarks: displacedLandmarks },
            { onProgress: (progress) => seen.push(progress), slice: { work: 200 } },
        );
        expect(seen.at(-1)?.phase).toBe("done");
        const counts = seen.flatMap(({ paths }) => (paths ? [paths.layoutEdges.length] : []));
        expect(counts.length).toBeGreaterThan(1);
        expect(counts).toEqual([...counts].sort((a, b) => a - b));
        const last = seen.flatMap(({ paths }) => paths ?? []).at(-1)!;
        expect(last.points).toHaveLength(3 * last.offsets.at(-1)!);
    });

    test("lets_other_events_be_handled_and_ends_when_aborted", async () => {
        const abort = new AbortController();
        const result = await embed(
            { layout: arrays(octahedron), target: arrays(sphere(5)) },
            {
                signal: abort.signal,
                slice: { work: 100 },
                onProgress: ({ phase }) => {
                    if (phase === "search") {
                        // Not from here: only an event that is handled in between can come.
                        setTimeout(() => abort.abort(), 0);
                    }
                },
            },
        );
        expect(result.status).toBe("cancelled");
        expect(result.refined).toBeNull();
        expect(result.cost).toBe(Infinity);
    });

    test("aborted_before_it_starts_is_cancelled_without_search", async () => {
        const signal = AbortSignal.abort();
        await expect(embed(problem, { signal })).rejects.toMatchObject({ code: "cancelled" });
        const session = await Session.create();
        await session.loadLayout(problem.layout);
        await session.loadTarget(problem.target);
        const result = await session.solve({ signal });
        expect(result.status).toBe("cancelled");
        expect(result.counters.expansions).toBe(0);
        await session.dispose();
    });

    test("looks_for_what_was_meant_instead_unless_told_not_to", async () => {
        const faces = octahedron.faces.map((face) => [...face].reverse());
        const mirrored = { ...problem, layout: arrays({ ...octahedron, faces }) };
        expect((await embed(mirrored)).doubts).toMatchObject([{ kind: "mirrored" }]);
        expect((await embed(mirrored, { doubts: false })).doubts).toEqual([]);
        await expect(embed(problem, { doubts: 1 as never })).rejects.toMatchObject({
            code: "invalidOption",
        });
    });

    test("stops_at_exactly_the_work_limit", async () => {
        const result = await embed(
            { ...problem, landmarks: displacedLandmarks },
            { workLimit: 500 },
        );
        expect(result.status).toBe("workLimit");
        expect(result.counters.expansions).toBe(500);
    });

    test("that_does_not_fit_into_memory_says_how_much_it_needs", async () => {
        const result = await embed(problem, { memoryLimit: 1000 });
        expect(result.status).toBe("memoryLimit");
        expect(result.message).toMatch(/needs about \d+ MB.*\.$/);
    });

    test("stops_at_a_time_limit_of_zero_seconds", async () => {
        const result = await embed(
            { layout: arrays(octahedron), target: arrays(sphere(5)) },
            { timeLimit: 0 },
        );
        expect(result.status).toBe("timeLimit");
    });

    test("refuses_options_that_make_no_sense", async () => {
        for (const options of [
            { gap: -1 },
            { gap: NaN },
            { seed: 1.5 },
            { seed: -1 },
            { timeLimit: -1 },
            { workLimit: NaN },
            { algorithm: "magic" as "greedy" },
            { slice: { work: 0 } },
        ]) {
            await expect(embed(problem, options), JSON.stringify(options)).rejects.toMatchObject({
                name: "LayoutError",
                code: "invalidOption",
            });
        }
    });
});

describe("a session", () => {
    test("keeps_what_was_loaded_when_another_load_fails", async () => {
        const session = await Session.create();
        await session.loadLayout(problem.layout);
        await session.loadTarget(problem.target);
        await session.setLandmarks(displacedLandmarks);
        const before = await session.solve();
        const open = { bytes: new TextEncoder().encode("nonsense"), name: "bad.obj" };
        await expect(session.loadTarget(open)).rejects.toBeInstanceOf(LayoutError);
        await expect(session.loadLayout(open)).rejects.toBeInstanceOf(LayoutError);
        await expect(session.setLandmarks([1, 1, 2, 3, 4, 5])).rejects.toBeInstanceOf(LayoutError);
        const after = await session.solve();
        expect(after.refined).toEqual(before.refined);
        await session.dispose();
    });

    test("shows_a_mesh_that_it_refuses_as_it_stands_in_the_file", async () => {
        const session = await Session.create();
        const bytes = new TextEncoder().encode("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\n");
        const error: unknown = await session
            .loadTarget({ bytes, name: "t.obj" })
            .catch((reason: unknown) => reason);
        expect(error).toMatchObject({ code: "unusedVertex", details: { vertex: 3 } });
        const shown = await session.inspect("target", { bytes, name: "t.obj" });
        expect([...shown.positions.slice(9)]).toEqual([9, 9, 9]);
        expect([...shown.corners]).toEqual([0, 1, 2]);
        expect([...shown.offsets]).toEqual([0, 3]);
        const mended = await session.inspect("target", { bytes }, { repair: true });
        expect(mended.positions).toHaveLength(9);
        await session.dispose();
    });

    test("exports_what_it_solved_even_if_the_result_was_changed", async () => {
        const session = await Session.create();
        await session.loadLayout(problem.layout);
        await session.loadTarget(problem.target);
        const result = await session.solve();
        const files = await session.exportFiles();
        result.refined!.positions.fill(NaN);
        result.edges.length = 0;
        expect(await session.exportFiles()).toEqual(files);
        expect(new TextDecoder().decode(files["refined.obj"])).toContain("g patch_0");
        await session.dispose();
    });

    test("reads_back_its_own_obj_with_the_same_numbers", async () => {
        const session = await Session.create();
        await session.loadLayout(problem.layout);
        await session.loadTarget(problem.target);
        const { refined } = await session.solve();
        const files = await session.exportFiles();
        const read = await session.loadTarget({ bytes: files["refined.obj"], name: "refined.obj" });
        expect(read.positions).toEqual(refined!.positions);
        expect(read.corners).toEqual(refined!.corners);
        await session.dispose();
    });

    test("says_what_is_missing_and_that_it_was_disposed_of", async () => {
        const session = await Session.create();
        await expect(session.solve()).rejects.toMatchObject({ code: "missingInput" });
        await expect(session.exportFiles()).rejects.toMatchObject({ code: "nothingToExport" });
        await session.dispose();
        await session.dispose();
        await expect(session.loadLayout(problem.layout)).rejects.toMatchObject({
            code: "disposed",
        });
    });

    test("disposed_of_while_solving_rejects", async () => {
        const session = await Session.create();
        await session.loadLayout(problem.layout);
        await session.loadTarget(problem.target);
        const solving = session.solve({ slice: { work: 10 } });
        await session.dispose();
        await expect(solving).rejects.toMatchObject({ code: "disposed" });
    });

    test("runs_several_jobs_in_turns_with_the_results_of_each_alone", async () => {
        const session = await Session.create();
        await session.loadLayout(problem.layout);
        await session.loadTarget(problem.target);
        await session.setLandmarks(displacedLandmarks);
        const alone = [await session.solve({ seed: 1 }), await session.solve({ seed: 2 })];
        const together = await Promise.all([
            session.solve({ seed: 1, slice: { work: 50 } }),
            session.solve({ seed: 2, slice: { work: 70 } }),
        ]);
        expect(together.map((result) => result.exactCost)).toEqual(
            alone.map((result) => result.exactCost),
        );
        await session.dispose();
    });

    test("maps_landmarks_through_a_repair", async () => {
        const target = sphere(2);
        // An unused vertex in front shifts all ids.
        const shifted = {
            positions: [9, 9, 9, ...target.positions],
            faces: target.faces.map((face) => face.map((vertex) => vertex + 1)),
        };
        const session = await Session.create();
        await session.loadLayout(problem.layout);
        await expect(session.loadTarget(arrays(shifted))).rejects.toMatchObject({
            code: "unusedVertex",
        });
        const info = await session.loadTarget(arrays(shifted), { repair: true });
        expect(info.vertexMap?.[0]).toBe(-1);
        expect(info.notes).toHaveLength(1);
        const { landmarks } = await session.setLandmarks([1, 2, 3, 4, 5, 6]);
        expect(Array.from(landmarks)).toEqual([0, 1, 2, 3, 4, 5]);
        await expect(session.setLandmarks([0, 2, 3, 4, 5, 6])).rejects.toMatchObject({
            code: "landmarkOutOfRange",
        });
        await session.setLandmarks([0, 1, 2, 3, 4, 5], { numbering: "loaded" });
        expect((await session.solve()).status).toBe("optimal");
        await session.dispose();
    });

    test("describes_layouts_and_targets", async () => {
        const session = await Session.create();
        const layout = await session.loadLayout(file(cube, "cube.obj"));
        expect(layout).toMatchObject({
            name: "cube.obj",
            vertexCount: 8,
            edgeCount: 12,
            faceCount: 6,
            eulerCharacteristic: 2,
            boundaryLoopCount: 0,
        });
        expect(layout.edges).toHaveLength(24);
        expect(Array.from(layout.offsets)).toEqual([0, 4, 8, 12, 16, 20, 24]);
        const target = await session.loadTarget(file(sphere(1), "sphere.obj"));
        expect(target).toMatchObject({ vertexCount: 18, faceCount: 32, edgeCount: 48 });
        await session.dispose();
    });
});

test("the_error_table_lists_every_code_once_with_meaning_and_advice", async () => {
    const infos = await errorInfos();
    expect(new Set(infos.map((info) => info.code)).size).toBe(infos.length);
    expect(infos.map((info) => info.code)).toEqual(
        expect.arrayContaining(["notTriangles", "internal", "workerTerminated"]),
    );
    expect(infos.every((info) => info.meaning !== "" && info.advice !== "")).toBe(true);
});
