// The command line on small meshes: output, exit codes, what it writes, and what `check` refuses.
import {
    chmodSync,
    existsSync,
    mkdirSync,
    readFileSync,
    readdirSync,
    writeFileSync,
} from "node:fs";
import path from "node:path";
import type { EmbeddingDocument, RefinedMapDocument } from "layout-embedding";
import { describe, expect, test } from "vitest";
import { inFolder, run } from "./command.js";
import { creased, displacedLandmarks, obj, octahedron, sphere } from "./meshes.js";

/** A folder with layout.obj, target.obj and landmarks.txt. */
function withInputs(body: (folder: string) => Promise<void>): () => Promise<void> {
    return () =>
        inFolder(async (folder) => {
            writeFileSync(path.join(folder, "layout.obj"), obj(octahedron));
            writeFileSync(path.join(folder, "target.obj"), obj(sphere(3)));
            writeFileSync(path.join(folder, "landmarks.txt"), displacedLandmarks.join("\n"));
            await body(folder);
        });
}

const inputs = ["layout.obj", "target.obj", "--landmarks", "landmarks.txt"];

function readJson<T>(...place: string[]): T {
    return JSON.parse(readFileSync(path.join(...place), "utf8")) as T;
}

function errorOf(stdout: string): { code: string; message: string } {
    return (JSON.parse(stdout) as { error: { code: string; message: string } }).error;
}

describe("embed", () => {
    test(
        "takes_another_route_for_an_edge_of_an_earlier_output",
        withInputs(async (cwd) => {
            const first = await run(["embed", ...inputs, "--output", "a", "--json"], { cwd });
            const before = JSON.parse(first.stdout) as EmbeddingDocument;
            const again = ["embed", "layout.obj", "target.obj", "--previous", "a", "--output", "b"];
            const second = await run(
                [...again, "--avoid", "5", "--keep", "0,1", "--work-limit", "300000", "--json"],
                {
                    cwd,
                },
            );
            expect(second).toMatchObject({ exitCode: 0, stderr: "" });
            const after = JSON.parse(second.stdout) as EmbeddingDocument;
            expect(after.landmarks).toEqual(before.landmarks);
            expect(after.cost).toBeGreaterThan(before.cost!);
            expect(after.constraints.map(({ rule, edge }) => [rule, edge])).toEqual([
                ["keep", 0],
                ["keep", 1],
                ["avoid", 5],
            ]);
            const check = await run(["check", "b", "layout.obj", "target.obj"], { cwd });
            expect(check.exitCode).toBe(0);
            for (const wrong of [
                ["embed", ...inputs, "--avoid", "5"],
                [...again, "--avoid", "x"],
                [...again, "--avoid", "12"],
            ]) {
                expect((await run(wrong, { cwd })).exitCode).toBe(2);
            }
        }),
    );

    test(
        "finds_the_next_best_embeddings_in_order_of_cost",
        withInputs(async (cwd) => {
            const embed = async (output: string, ...args: string[]) => {
                const options = ["--gap", "0", "--output", output, "--json"];
                const finished = await run(["embed", ...args, ...options], { cwd });
                expect(finished).toMatchObject({ exitCode: 0, stderr: "" });
                const check = await run(["check", output, "layout.obj", "target.obj"], { cwd });
                expect(check.exitCode).toBe(0);
                const document = JSON.parse(finished.stdout) as EmbeddingDocument;
                expect(document.gap).toBe(0);
                return document;
            };
            const files = ["layout.obj", "target.obj"];
            const best = await embed("best", ...inputs);
            const second = await embed("second", ...files, "--exclude", "best");
            const third = await embed(
                "third",
                ...files,
                "--exclude",
                "best",
                "--exclude",
                "second",
            );
            expect(second.landmarks).toEqual(best.landmarks);
            expect(second.cost).toBeGreaterThan(best.cost!);
            expect(third.cost).toBeGreaterThan(second.cost!);
            const paths = ({ edges }: EmbeddingDocument) => edges.map(({ weakPath }) => weakPath);
            expect(third.excluded).toEqual([paths(best), paths(second)]);
            expect(paths(third)).not.toEqual(paths(best));
            const refused = await run(
                ["embed", ...files, "--exclude", "best", "--algorithm", "greedy", "--json"],
                { cwd },
            );
            expect(refused.exitCode).toBe(2);
            expect(errorOf(refused.stdout).code).toBe("invalidOption");
            const missing = await run(["embed", ...inputs, "--exclude", "none", "--json"], { cwd });
            expect(missing.exitCode).toBe(4);
            expect(errorOf(missing.stdout).code).toBe("damagedOutput");
        }),
    );

    test(
        "edges_that_count_more_go_straight",
        withInputs(async (cwd) => {
            const embed = async (output: string, weights: number[]) => {
                writeFileSync(path.join(cwd, "weights.txt"), weights.join("\n"));
                const args = [...inputs, "--gap", "0", "--edge-weights", "weights.txt"];
                const finished = await run(["embed", ...args, "--output", output, "--json"], {
                    cwd,
                });
                expect(finished).toMatchObject({ exitCode: 0, stderr: "" });
                const check = await run(["check", output, "layout.obj", "target.obj"], { cwd });
                expect(check).toMatchObject({ exitCode: 0 });
                return JSON.parse(finished.stdout) as EmbeddingDocument;
            };
            const plain = await embed("plain", Array<number>(12).fill(1));
            // The longest path is dear: it may only become shorter.
            const longest = plain.edges.reduce((a, b) => (b.cost > a.cost ? b : a)).id;
            const dear = await embed(
                "dear",
                plain.edges.map(({ id }) => (id === longest ? 16 : 1)),
            );
            expect(dear.edges[longest]!.cost / 16).toBeLessThanOrEqual(
                plain.edges[longest]!.cost * (1 + 1e-6),
            );
            expect(dear.metric.edgeWeights).toHaveLength(12);
            // What the document says of weights counts when its cost is checked.
            const file = path.join(cwd, "dear/embedding.json");
            const document = readJson<EmbeddingDocument>(file);
            document.metric.edgeWeights![longest] = 15;
            writeFileSync(file, JSON.stringify(document));
            const tampered = await run(["check", "dear", "layout.obj", "target.obj", "--json"], {
                cwd,
            });
            expect(tampered.exitCode).toBe(4);
            expect(tampered.stdout).toContain("costWrong");
            for (const wrong of ["1 1 1", Array(12).fill("0").join(" ")]) {
                writeFileSync(path.join(cwd, "wrong.txt"), wrong);
                const refused = await run(
                    ["embed", ...inputs, "--edge-weights", "wrong.txt", "--json"],
                    { cwd },
                );
                expect(refused.exitCode).toBe(2);
                expect(errorOf(refused.stdout).code).toBe("invalidOption");
            }
        }),
    );

    test(
        "in_another_metric_paths_follow_sharp_edges_and_stay_away_from_where_length_is_dear",
        withInputs(async (cwd) => {
            const target = creased(3);
            writeFileSync(path.join(cwd, "target.obj"), obj(target));
            const x = (vertex: number) => target.positions[3 * vertex]!;
            const dear = target.positions.flatMap((_, i) =>
                i % 3 === 0 ? [x(i / 3) > 0.2 ? "5" : "1"] : [],
            );
            writeFileSync(path.join(cwd, "dear.txt"), dear.join("\n"));
            const embed = async (output: string, ...more: string[]) => {
                const args = ["embed", ...inputs, "--shape", "even", "--gap", "0", ...more];
                const finished = await run([...args, "--output", output, "--json"], { cwd });
                expect(finished).toMatchObject({ exitCode: 0, stderr: "" });
                const check = await run(["check", output, "layout.obj", "target.obj"], { cwd });
                expect(check.exitCode).toBe(0);
                const document = JSON.parse(finished.stdout) as EmbeddingDocument;
                const steps = document.edges.flatMap(({ weakPath }) =>
                    weakPath.slice(1).map((b, i) => [weakPath[i]!, b] as const),
                );
                const isOnCrease = (point: readonly number[]) =>
                    [0, 1, 2].some((axis) =>
                        point.every((v) => Math.abs(target.positions[3 * v + axis]!) < 1e-9),
                    );
                return {
                    document,
                    creased: steps.filter((step) => step.every(isOnCrease)).length / steps.length,
                    dear: steps.filter((step) => step.flat().every((v) => x(v) > 0.2)).length,
                };
            };
            const plain = await embed("plain");
            const creases = await embed("creases", "--features", "0.9");
            expect(creases.creased).toBeGreaterThan(plain.creased + 0.1);
            expect(creases.document.cost).toBeLessThan(plain.document.cost!);
            const away = await embed("away", "--vertex-costs", "dear.txt");
            expect(away.dear).toBeLessThan(plain.dear);
            expect(away.document.metric.vertexCosts).toHaveLength(dear.length);
            // What the document says of the metric counts when its cost is checked.
            const file = path.join(cwd, "creases/embedding.json");
            writeFileSync(
                file,
                readFileSync(file, "utf8").replace(
                    /"featureDiscount":\s*0.9/,
                    '"featureDiscount": 0.8',
                ),
            );
            const tampered = await run(["check", "creases", "layout.obj", "target.obj", "--json"], {
                cwd,
            });
            expect(tampered.exitCode).toBe(4);
            expect(tampered.stdout).toContain("costWrong");
            writeFileSync(path.join(cwd, "few.txt"), "1 1 0");
            for (const wrong of [
                ["--features", "1"],
                ["--vertex-costs", "few.txt"],
            ]) {
                const refused = await run(["embed", ...inputs, ...wrong, "--json"], { cwd });
                expect(refused.exitCode).toBe(2);
                expect(errorOf(refused.stdout).code).toBe("invalidOption");
            }
        }),
    );

    test(
        "writes_three_files_that_agree_with_each_other_and_with_its_output",
        withInputs(async (cwd) => {
            const finished = await run(["embed", ...inputs, "--output", "a/b", "--json"], { cwd });
            expect(finished).toMatchObject({ exitCode: 0, stderr: "" });
            expect(readdirSync(path.join(cwd, "a/b")).sort()).toEqual([
                "embedding.json",
                "refined.obj",
                "refined_map.json",
            ]);
            const written = readJson<EmbeddingDocument>(cwd, "a/b/embedding.json");
            const { files, ...printed } = JSON.parse(finished.stdout) as { files: string[] };
            expect(printed).toEqual(written);
            expect(files).toHaveLength(3);
            expect(written).toMatchObject({
                version: 1,
                algorithm: "exact",
                seed: 1,
                limits: { gap: 0.01, timeLimit: null, workLimit: null, memoryLimit: null },
                landmarks: displacedLandmarks,
            });
            expect(written.inputs.map((input) => input.name)).toEqual([
                "layout.obj",
                "target.obj",
                "landmarks.txt",
            ]);
            expect(written.inputs.every((input) => /^[0-9a-f]{64}$/.test(input.sha256!))).toBe(
                true,
            );
            expect(written.edges).toHaveLength(12);
            const lines = readFileSync(path.join(cwd, "a/b/refined.obj"), "utf8")
                .split("\n")
                .filter((line) => line.startsWith("l "));
            expect(lines).toEqual(
                written.edges.map((edge) => `l ${edge.chain.map((id) => id + 1).join(" ")}`),
            );
            const map = readJson<RefinedMapDocument>(cwd, "a/b/refined_map.json");
            expect(map.triangleFaces).toHaveLength(written.patches.length);
            expect(map.targetVertexCount).toBe(258);
        }),
    );

    test(
        "writes_nothing_and_says_why_when_the_work_limit_ends_it",
        withInputs(async (cwd) => {
            const args = ["embed", ...inputs, "--work-limit", "100", "--output", "out", "--json"];
            const finished = await run(args, { cwd });
            expect(finished.exitCode).toBe(1);
            expect(JSON.parse(finished.stdout)).toMatchObject({
                status: "workLimit",
                cost: null,
                edges: [],
            });
            expect(existsSync(path.join(cwd, "out"))).toBe(false);
        }),
    );

    test(
        "interrupted_ends_with_130",
        withInputs(async (cwd) => {
            writeFileSync(path.join(cwd, "target.obj"), obj(sphere(7)));
            const output = path.join(cwd, "out");
            const finished = await run(["embed", "layout.obj", "target.obj", "--output", output], {
                cwd,
                onStart: (kill) => {
                    // The output folder is made first of all; the rest takes a second and more.
                    const timer = setInterval(() => {
                        if (existsSync(output)) {
                            clearInterval(timer);
                            kill("SIGINT");
                        }
                    }, 10);
                },
            });
            expect(finished.exitCode).toBe(130);
        }),
    );

    test(
        "prints_a_summary_for_people_and_nothing_when_quiet",
        withInputs(async (cwd) => {
            const loud = await run(["embed", ...inputs], { cwd });
            expect(loud.stdout).toMatch(/12 edges embedded[^]*lower|at least[^]*path-graph metric/);
            expect(loud.stderr).toBe("");
            const quiet = await run(["embed", ...inputs, "--quiet"], { cwd });
            expect(quiet).toMatchObject({ exitCode: 0, stdout: "", stderr: "" });
        }),
    );

    test(
        "says_that_the_mirror_image_of_the_layout_fits_far_better",
        withInputs(async (cwd) => {
            const faces = octahedron.faces.map((face) => [...face].reverse());
            const layout = obj({ positions: octahedron.positions, faces });
            writeFileSync(path.join(cwd, "layout.obj"), layout);
            // The sphere is a subdivided octahedron.
            writeFileSync(path.join(cwd, "landmarks.txt"), "0\n1\n2\n3\n4\n5\n");
            const args = ["embed", ...inputs, "--work-limit", "100000"];
            const finished = await run(args, { cwd });
            expect(finished.exitCode).toBe(0);
            expect(finished.stderr).toMatch(/^note: the mirror image of the layout [^\n]+\.\n$/);
            const json = await run([...args, "--json"], { cwd });
            const { doubts, cost } = JSON.parse(json.stdout) as EmbeddingDocument;
            expect(doubts).toMatchObject([{ kind: "mirrored", vertices: null }]);
            expect(doubts[0]!.cost).toBeLessThan(0.75 * cost!);
        }),
    );

    test(
        "repairs_when_asked_and_says_what_it_did",
        withInputs(async (cwd) => {
            const target = `${obj(sphere(3))}v 5 5 5\n`;
            writeFileSync(path.join(cwd, "target.obj"), target);
            expect((await run(["embed", ...inputs], { cwd })).exitCode).toBe(2);
            const args = ["embed", ...inputs, "--repair", "--output", "out"];
            const finished = await run(args, { cwd });
            expect(finished.exitCode).toBe(0);
            expect(finished.stderr).toMatch(/^note: the target target.obj: .+\n$/);
            const check = ["check", "out", "layout.obj", "target.obj"];
            expect((await run(check, { cwd })).exitCode).toBe(2);
            expect((await run([...check, "--repair"], { cwd })).exitCode).toBe(0);
        }),
    );
});

describe("usage", () => {
    test("help_and_version_succeed", async () => {
        for (const args of [["--help"], ["-h"], ["embed", "--help"], ["check", "--help"]]) {
            const finished = await run(args);
            expect(finished).toMatchObject({ exitCode: 0, stderr: "" });
            expect(finished.stdout).toMatch(/Usage[^]*--landmarks[^]*Exit codes/);
        }
        expect((await run(["--version"])).stdout).toMatch(/^\d+\.\d+\.\d+\n$/);
    });

    test.each<[string, string[], string]>([
        ["no_command", [], "usage"],
        ["unknown_command", ["embd"], "usage"],
        ["no_files", ["embed"], "usage"],
        ["one_file", ["embed", "layout.obj"], "usage"],
        ["three_files", ["embed", "layout.obj", "target.obj", "more.obj"], "usage"],
        ["unknown_option", ["embed", "layout.obj", "target.obj", "--fast"], "usage"],
        ["option_without_value", ["embed", "layout.obj", "target.obj", "--gap"], "usage"],
        [
            "word_for_number",
            ["embed", "layout.obj", "target.obj", "--gap", "small"],
            "invalidOption",
        ],
        ["hexadecimal", ["embed", "layout.obj", "target.obj", "--seed", "0x10"], "invalidOption"],
        ["empty_number", ["embed", "layout.obj", "target.obj", "--seed="], "invalidOption"],
        [
            "negative_limit",
            ["embed", "layout.obj", "target.obj", "--time-limit=-1"],
            "invalidOption",
        ],
        ["gap_over_1", ["embed", "layout.obj", "target.obj", "--gap", "2"], "invalidOption"],
        [
            "fraction_as_seed",
            ["embed", "layout.obj", "target.obj", "--seed", "1.5"],
            "invalidOption",
        ],
        [
            "unknown_algorithm",
            ["embed", "layout.obj", "target.obj", "--algorithm", "x"],
            "invalidOption",
        ],
        ["missing_target", ["embed", "layout.obj", "none.obj"], "fileNotFound"],
        [
            "missing_landmarks",
            ["embed", "layout.obj", "target.obj", "--landmarks", "no"],
            "fileNotFound",
        ],
        ["folder_as_layout", ["embed", ".", "target.obj"], "fileUnreadable"],
        [
            "output_is_a_file",
            ["embed", "layout.obj", "target.obj", "--output", "layout.obj"],
            "outputFailed",
        ],
        [
            "output_below_a_file",
            ["embed", "layout.obj", "target.obj", "--output", "layout.obj/x"],
            "outputFailed",
        ],
        ["check_without_folder", ["check", "nothing", "layout.obj", "target.obj"], "fileNotFound"],
        ["check_of_a_file", ["check", "layout.obj", "layout.obj", "target.obj"], "usage"],
    ])("%s_is_refused_with_2_and_one_sentence", (_, args, code) =>
        withInputs(async (cwd) => {
            const json = await run(["--json", ...args], { cwd });
            expect(json).toMatchObject({ exitCode: 2, stderr: "" });
            const { code: found, message } = errorOf(json.stdout);
            expect(found).toBe(code);
            const plain = await run(args, { cwd });
            expect(plain).toMatchObject({ exitCode: 2, stdout: "", stderr: `error: ${message}\n` });
            expect(message).toMatch(/^[^\n]+\.$/);
        })(),
    );

    test.each([
        ["--fast", ["--fast"], /^there is no option --fast here;/],
        ["no_value_at_the_end", ["--gap"], /^--gap needs a value;/],
        ["another_option_as_value", ["--gap", "--json"], /^--gap needs a value;/],
        ["dash_before_a_value", ["--gap", "-1"], /one that begins with a dash is given as --gap=/],
        ["value_of_a_flag", ["--json=3"], /^--json takes no value;/],
    ])("%s_is_named_in_the_error", async (_, args, sentence) => {
        const { stdout } = await run(["--json", "embed", "layout.obj", "target.obj", ...args]);
        expect(errorOf(stdout).message).toMatch(sentence);
    });

    test("a_file_that_may_not_be_read_is_refused", async (context) => {
        context.skip(process.getuid?.() === 0, "root may read every file");
        await withInputs(async (cwd) => {
            chmodSync(path.join(cwd, "target.obj"), 0);
            const finished = await run(["embed", ...inputs, "--json"], { cwd });
            expect(finished.exitCode).toBe(2);
            expect(errorOf(finished.stdout).code).toBe("fileUnreadable");
        })();
    });
});

describe("check", () => {
    type Change = (folder: string) => void;

    /** Changes embedding.json. */
    const document =
        (change: (document: EmbeddingDocument) => void): Change =>
        (folder) => {
            const value = readJson<EmbeddingDocument>(folder, "embedding.json");
            change(value);
            writeFileSync(path.join(folder, "embedding.json"), JSON.stringify(value));
        };
    const map =
        (change: (map: RefinedMapDocument) => void): Change =>
        (folder) => {
            const value = readJson<RefinedMapDocument>(folder, "refined_map.json");
            change(value);
            writeFileSync(path.join(folder, "refined_map.json"), JSON.stringify(value));
        };
    const objText =
        (change: (text: string) => string): Change =>
        (folder) => {
            const file = path.join(folder, "refined.obj");
            const before = readFileSync(file, "utf8");
            const after = change(before);
            expect(after).not.toBe(before);
            writeFileSync(file, after);
        };

    const changes: [string, Change][] = [
        ["a_shorter_cost", document((d) => (d.cost! *= 0.9))],
        ["a_bound_above_the_cost", document((d) => (d.lowerBound = d.cost! * 1.1))],
        ["a_smaller_gap", document((d) => (d.gap = -1))],
        ["another_length", document((d) => (d.edges[3]!.length *= 0.99))],
        ["a_chain_without_a_vertex", document((d) => d.edges[0]!.chain.splice(1, 1))],
        ["two_edges_swapped", document((d) => d.edges.reverse())],
        ["an_edge_left_out", document((d) => d.edges.pop())],
        ["a_weak_path_reversed", document((d) => d.edges[2]!.weakPath.reverse())],
        ["another_landmark", document((d) => (d.landmarks[0] = 5))],
        ["a_landmark_that_does_not_exist", document((d) => (d.landmarks[0] = 12345))],
        ["another_patch", document((d) => (d.patches[7] = d.patches[7] === 0 ? 1 : 0))],
        ["no_edges", document((d) => (d.edges = []))],
        ["a_text_as_cost", document((d) => ((d as { cost: unknown }).cost = "1"))],
        ["another_version", document((d) => (d.version = 2))],
        ["another_target_face", map((m) => (m.triangleFaces[0] = m.triangleFaces[0]! + 1))],
        ["another_place_of_a_new_vertex", map((m) => (m.newVertices[0]!.barycentric = [1, 0, 0]))],
        ["a_negative_face", map((m) => (m.newVertices[0]!.face = -1))],
        ["a_missing_triangle", map((m) => m.triangleFaces.pop())],
        ["a_moved_vertex", objText((text) => text.replace(/^v .*$/m, "v 0.9 0 0"))],
        ["a_flipped_triangle", objText((text) => text.replace(/^f (\d+) (\d+)/m, "f $2 $1"))],
        ["another_group", objText((text) => text.replace(/^g patch_0$/m, "g patch_1"))],
        ["another_line", objText((text) => text.replace(/^l (\d+) \d+/m, "l $1"))],
        ["a_torn_file", objText((text) => text.slice(0, text.length / 2))],
        ["no_obj_at_all", objText(() => "nonsense")],
        ["json_cut_short", (folder) => writeFileSync(path.join(folder, "embedding.json"), "{")],
    ];

    test(
        "accepts_what_embed_wrote_and_refuses_every_change_of_it",
        withInputs(async (cwd) => {
            await run(["embed", ...inputs, "--output", "good"], { cwd });
            const files = ["embedding.json", "refined.obj", "refined_map.json"].map(
                (name) => [name, readFileSync(path.join(cwd, "good", name))] as const,
            );
            const accepted = await run(["check", "good", ...inputs, "--json"], { cwd });
            expect(accepted).toMatchObject({ exitCode: 0, stderr: "" });
            expect(JSON.parse(accepted.stdout)).toMatchObject({ valid: true, edges: 12 });
            for (const [name, change] of changes) {
                const folder = path.join(cwd, name);
                mkdirSync(folder);
                files.forEach(([file, bytes]) => writeFileSync(path.join(folder, file), bytes));
                change(folder);
                const refused = await run(["check", name, "layout.obj", "target.obj"], { cwd });
                expect(refused.exitCode, `${name}: ${refused.stdout} ${refused.stderr}`).toBe(4);
            }
        }),
        180_000,
    );

    test(
        "refuses_an_embedding_with_other_landmarks_than_given",
        withInputs(async (cwd) => {
            await run(["embed", "layout.obj", "target.obj", "--output", "out"], { cwd });
            const finished = await run(["check", "out", ...inputs, "--json"], { cwd });
            expect(finished.exitCode).toBe(4);
            expect(JSON.parse(finished.stdout)).toMatchObject({
                valid: false,
                violations: [{ code: "landmarksDiffer" }],
            });
        }),
    );

    test(
        "refuses_a_folder_without_the_files",
        withInputs(async (cwd) => {
            mkdirSync(path.join(cwd, "empty"));
            const finished = await run(["check", "empty", ...inputs, "--json"], { cwd });
            expect(finished.exitCode).toBe(4);
            expect(errorOf(finished.stdout).code).toBe("damagedOutput");
        }),
    );
});
