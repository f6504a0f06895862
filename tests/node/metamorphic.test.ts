// What must not change an embedding: other labels, another place, another size, both sides
// mirrored, flat faces cut into smaller ones. Instances are drawn by fast-check from a fixed seed.
import fc from "fast-check";
import { Session, type EmbedResult, type WeakPoint } from "layout-embedding";
import { describe, expect, test } from "vitest";
import { arrays, octahedron, sphere, type Mesh } from "./meshes.js";

interface Instance {
    layout: Mesh;
    target: Mesh;
    landmarks: number[];
}

/** Lengths in the path graph are whole multiples of about 1e-7 of a typical edge. */
const tolerance = 1e-6;

const ball = sphere(2);
const ballVertices = ball.positions.length / 3;

/** Numbers in [0, 1) that follow from `seed`; fast-check's own are often the same, which ties paths. */
function numbers(seed: number, count: number): number[] {
    let state = seed;
    return Array.from({ length: count }, () => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return state / 2 ** 32;
    });
}

/** A ball whose vertices are moved along their rays, with landmarks anywhere. */
const instances = fc
    .record({
        seed: fc.nat(),
        landmarks: fc.uniqueArray(fc.nat(ballVertices - 1), { minLength: 6, maxLength: 6 }),
    })
    .map(({ seed, landmarks }): Instance => {
        const radii = numbers(seed, ballVertices).map((x) => 0.7 + 0.7 * x);
        const positions = ball.positions.map((x, i) => x * radii[Math.floor(i / 3)]!);
        return { layout: octahedron, target: { ...ball, positions }, landmarks };
    });

/** Orders of the numbers below `count`. */
const orders = (count: number) =>
    fc.shuffledSubarray([...Array(count).keys()], { minLength: count });

type Embedding = Pick<EmbedResult, "cost" | "edges">;

/** The shortest embedding of an instance, checked, with some of its routes kept if asked to. */
async function solved(
    { layout, target, landmarks }: Instance,
    kept: readonly WeakPoint[][] = [],
): Promise<Embedding> {
    const session = await Session.create();
    await session.loadLayout(arrays(layout));
    await session.loadTarget(arrays(target));
    await session.setLandmarks(landmarks);
    const constraints = kept.map((path, edge) => ({ rule: "keep" as const, edge, path }));
    const { status, cost, edges, refined } = await session.solve({ gap: 0, constraints });
    expect(status).toBe("optimal");
    expect(await session.check({ refined: refined!, edges })).toEqual([]);
    await session.dispose();
    return { cost, edges };
}

/** An edge's path between two layout vertices, whichever way it is written, in other labels. */
function routes(
    { edges }: Embedding,
    layoutVertex = (id: number) => id,
    targetVertex = (id: number) => id,
): Map<string, string> {
    return new Map(
        edges.map(({ layoutEdge, weakPath }) => {
            const [a, b] = layoutEdge.map(layoutVertex) as [number, number];
            const path = weakPath.map((point) =>
                point
                    .map(targetVertex)
                    .sort((p, q) => p - q)
                    .join("+"),
            );
            return [`${Math.min(a, b)}-${Math.max(a, b)}`, (a < b ? path : path.reverse()).join()];
        }),
    );
}

/** The mesh with vertex v as number order[v], its faces in the order of `faceOrder`. */
function relabelled({ positions, faces }: Mesh, order: number[], faceOrder: number[]): Mesh {
    const moved: number[] = [];
    order.forEach((to, from) => {
        for (let k = 0; k < 3; ++k) moved[3 * to + k] = positions[3 * from + k]!;
    });
    return {
        positions: moved,
        faces: faceOrder.map((f) => {
            const face = faces[f]!.map((vertex) => order[vertex]!);
            // Another corner comes first, too.
            return [...face.slice(f % 3), ...face.slice(0, f % 3)];
        }),
    };
}

/** The inverse of an order. */
function inverse(order: number[]): (id: number) => number {
    const back: number[] = [];
    order.forEach((to, from) => (back[to] = from));
    return (id) => back[id]!;
}

const runs = { seed: 1, numRuns: 10 } as const;

function expectSameCost(one: Embedding, other: Embedding, factor = 1): void {
    expect(Math.abs(other.cost / factor - one.cost)).toBeLessThan(tolerance * one.cost);
}

describe("an embedding stays the same", () => {
    test("when_the_target_gets_other_labels", () =>
        fc.assert(
            fc.asyncProperty(
                instances,
                orders(ballVertices),
                orders(ball.faces.length),
                async (instance, order, faceOrder) => {
                    const before = await solved(instance);
                    const after = await solved({
                        layout: instance.layout,
                        target: relabelled(instance.target, order, faceOrder),
                        landmarks: instance.landmarks.map((v) => order[v]!),
                    });
                    expectSameCost(before, after);
                    expect(routes(after, undefined, inverse(order))).toEqual(routes(before));
                },
            ),
            runs,
        ));

    test("when_the_layout_gets_other_labels", () =>
        fc.assert(
            fc.asyncProperty(
                instances,
                orders(6),
                orders(8),
                async (instance, order, faceOrder) => {
                    const before = await solved(instance);
                    const back = inverse(order);
                    const after = await solved({
                        layout: relabelled(instance.layout, order, faceOrder),
                        target: instance.target,
                        landmarks: instance.landmarks.map((_, i) => instance.landmarks[back(i)]!),
                    });
                    expectSameCost(before, after);
                    expect(routes(after, back)).toEqual(routes(before));
                },
            ),
            runs,
        ));

    const angle = fc.double({ min: 0, max: 2 * Math.PI, noNaN: true });
    test("when_the_target_is_turned_moved_and_scaled", () =>
        fc.assert(
            fc.asyncProperty(
                instances,
                fc.tuple(angle, angle),
                fc.double({ min: -3, max: 3, noNaN: true }),
                async (instance, [a, b], exponent) => {
                    const scale = 10 ** exponent;
                    const before = await solved(instance);
                    const positions = [...instance.target.positions];
                    for (let i = 0; i < positions.length; i += 3) {
                        const [x, y, z] = positions.slice(i, i + 3) as [number, number, number];
                        const u = x * Math.cos(a) - y * Math.sin(a);
                        const v = x * Math.sin(a) + y * Math.cos(a);
                        const turned = [
                            u,
                            v * Math.cos(b) - z * Math.sin(b),
                            v * Math.sin(b) + z * Math.cos(b),
                        ];
                        turned.forEach((value, k) => (positions[i + k] = scale * (value + k)));
                    }
                    const target = { ...instance.target, positions };
                    const after = await solved({ ...instance, target });
                    expectSameCost(before, after, scale);
                    expect(routes(after)).toEqual(routes(before));
                },
            ),
            runs,
        ));

    test("when_layout_and_target_are_mirrored", () =>
        fc.assert(
            fc.asyncProperty(instances, async (instance) => {
                const mirrored = ({ positions, faces }: Mesh): Mesh => ({
                    positions: positions.map((x, i) => (i % 3 === 0 ? -x : x)),
                    faces: faces.map((face) => [...face].reverse()),
                });
                const before = await solved(instance);
                const after = await solved({
                    layout: mirrored(instance.layout),
                    target: mirrored(instance.target),
                    landmarks: instance.landmarks,
                });
                expectSameCost(before, after);
                expect(routes(after)).toEqual(routes(before));
            }),
            runs,
        ));
});

describe("with every face of the target cut into three flat ones", () => {
    /** New vertices at the faces' centroids. */
    function cut({ positions, faces }: Mesh): Mesh {
        const count = positions.length / 3;
        const centroids = faces.flatMap((face) =>
            [0, 1, 2].map((k) => face.reduce((sum, v) => sum + positions[3 * v + k]!, 0) / 3),
        );
        return {
            positions: [...positions, ...centroids],
            faces: faces.flatMap(([a, b, c], f) => [
                [a!, b!, count + f],
                [b!, c!, count + f],
                [c!, a!, count + f],
            ]),
        };
    }

    /** A path as it reads after the cut: through the old centroids, which are vertices now. */
    function carried(path: readonly WeakPoint[], { positions, faces }: Mesh): WeakPoint[] {
        const count = positions.length / 3;
        const key = (ids: readonly number[]) => [...ids].sort((p, q) => p - q).join();
        const faceOf = new Map(faces.map((face, f) => [key(face), count + f]));
        return path.flatMap((point, i) => {
            const here = point.length === 3 ? [faceOf.get(key(point))!] : [...point];
            const next = path[i + 1];
            const rim = [point, next ?? []].find(({ length }) => length === 1 || length === 2);
            const centre = [point, next ?? []].find(({ length }) => length === 3);
            // Half-way to the old centroid lies the middle of a new edge or face.
            return next && rim && centre ? [here, [...rim, faceOf.get(key(centre))!]] : [here];
        });
    }

    test("the_routes_stay_and_the_cost_sinks_by_at_most_five_percent", () =>
        fc.assert(
            fc.asyncProperty(instances, async (instance) => {
                const before = await solved(instance);
                const target = cut(instance.target);
                const after = await solved({ ...instance, target });
                // All the old paths are still there, with others beside them.
                expect(after.cost).toBeLessThan(before.cost * (1 + tolerance));
                expect(after.cost).toBeGreaterThan(0.95 * before.cost);
                const kept = before.edges.map(({ weakPath }) => carried(weakPath, instance.target));
                const same = await solved({ ...instance, target }, kept);
                expectSameCost(after, same);
            }),
            runs,
        ));
});
