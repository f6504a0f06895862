// Fig. 15: maps between two targets, with and without a twist.
import { texturePicture } from "./drawing/picture.mjs";
import { cross, dot, minus, normalized } from "../bench/vectors.mjs";
import { names } from "./methods.mjs";
import { readMember, shippedShapes } from "./problems.mjs";
import { claimsOf, judge } from "./report/claims.mjs";
import { findings, number, picture, pictures, table } from "./report/html.mjs";
import { openSession, solveAndRecord } from "./solving.mjs";

export const title = "Maps between surfaces (Fig. 15)";

/** Where both targets are seen from, and the texture is put on. */
const view = { direction: [0.25, 0.1, 0.95], up: [0, 1, 0] };

export async function run({ pool, quick }) {
    const pairs = (quick ? ["human"] : ["human", "hand"]).map((name) => ({
        name,
        heuristic: "kraevoy",
    }));
    return { pairs: await pool.all("maps", "map", pairs) };
}

export const tasks = {
    /** Maps from the first member to the second, after a heuristic and after the exact method. */
    async map({ name, heuristic }) {
        const { members, title: shown } = shippedShapes().find((shape) => shape.name === name);
        // The layout is made of the member that is harder to come from: the second one.
        const [target, reference] = members;
        const template = readMember(reference);
        const maps = [];
        for (const algorithm of [heuristic, "exact"]) {
            const session = await openSession({ template, ...readMember(reference) });
            await solveAndRecord(session, { algorithm, gap: 0 });
            await session.setReference();
            const info = await loadTargetOnly(session, readMember(target));
            const { result } = await solveAndRecord(session, { algorithm, gap: 0 });
            maps.push({
                algorithm,
                length: result.cost,
                ...(await mapped(session, `map-${name}-${algorithm}`, info, result)),
            });
        }
        return { shown, reference: reference.name, target: target.name, maps };
    },
};

async function loadTargetOnly(session, { target, landmarks }) {
    const info = await session.loadTarget(target);
    await session.setLandmarks(landmarks);
    return info;
}

/** The map's distortion and pictures of a texture on both targets, or { error }. */
async function mapped(session, name, info, result) {
    let map;
    try {
        map = await session.mapFromReference();
    } catch (error) {
        return { error: error.message };
    }
    const { overlay, distortion, firstDistortion } = map;
    const { corners, referencePositions, targetPositions } = overlay;
    const lines = result.edges.map(({ chain }) =>
        Array.from(chain).flatMap((v) =>
            Array.from(result.refined.positions.subarray(3 * v, 3 * v + 3)),
        ),
    );
    const colourOf = frontTexture(referencePositions, corners);
    return {
        distortion,
        firstDistortion,
        vertices: info.vertexCount,
        triangles: corners.length / 3,
        pictures: [
            texturePicture(`${name}-reference`, referencePositions, corners, colourOf, { view }),
            texturePicture(`${name}-target`, targetPositions, corners, colourOf, { view }),
            texturePicture(`${name}-paths`, targetPositions, corners, colourOf, { view, lines }),
        ],
    };
}

/** A checkerboard on what faces the eye; the rest is grey. Carried along by the map's triangles. */
function frontTexture(positions, corners) {
    const z = normalized(view.direction);
    const x = normalized(cross(view.up, z));
    const y = cross(z, x);
    const at = (v) => Array.from(positions.subarray(3 * v, 3 * v + 3));
    let low = Infinity;
    let high = -Infinity;
    for (let v = 0; 3 * v < positions.length; ++v) {
        low = Math.min(low, dot(at(v), y));
        high = Math.max(high, dot(at(v), y));
    }
    const cell = (high - low) / 22;
    const triangles = Array.from({ length: corners.length / 3 }, (_, t) => {
        const points = [0, 1, 2].map((k) => at(corners[3 * t + k]));
        const [a, b, c] = points;
        const normal = cross(minus(b, a), minus(c, a));
        return {
            isFront: dot(normal, z) > 0,
            plane: points.map((p) => [dot(p, x) / cell, (dot(p, y) - low) / cell]),
        };
    });
    return (t, weights) => {
        const { isFront, plane } = triangles[t];
        if (!isFront) {
            return [205, 205, 210];
        }
        const [u, v] = [0, 1].map((axis) =>
            weights.reduce((sum, weight, k) => sum + weight * plane[k][axis], 0),
        );
        const shade = (Math.floor(u) + Math.floor(v)) % 2 === 0 ? 1 : 0.62;
        const height = v / 22;
        return [60 + 195 * height, 200 - 90 * Math.abs(2 * height - 1), 255 - 195 * height].map(
            (value) => shade * value,
        );
    };
}

export function section({ pairs }) {
    const worse = pairs.map(({ maps: [greedy, exact] }) =>
        greedy.error || exact.error
            ? null
            : greedy.distortion.meanEnergy / exact.distortion.meanEnergy,
    );
    const known = worse.filter((value) => value !== null);
    return [
        findings(
            "Greedy embeddings on two models can lie in different classes; the map that starts from them is twisted, and optimising it cannot undo that. Branch and bound gives the expected class on both, and optimisation reaches the expected map.",
            `Maps from one member of a class to another, each optimised (symmetric Dirichlet energy, 4 for an isometry), once from a heuristic’s embeddings and once from the exact method’s. ${known.length > 0 ? `The twisted maps have ${known.map((value) => number(value, 1)).join(", ")} times the energy of the others.` : ""} ${pairs.some(({ maps }) => maps[0].error) ? "Where no map could be made of a heuristic’s embeddings, the reason is given." : ""}`,
        ),
        ...pairs.map(
            ({ shown, reference, target, maps }) =>
                `<h3>${shown}: from “${reference}” to “${target}”</h3>${pictures([
                    ...maps
                        .filter(({ error }) => !error)
                        .slice(-1)
                        .map(({ pictures: files }) =>
                            picture(files[0], `a texture on the front of “${reference}”`),
                        ),
                    ...maps.flatMap(({ algorithm, error, pictures: files }) =>
                        error
                            ? [
                                  `<figure class="picture"><figcaption>${names[algorithm]}: ${error}</figcaption></figure>`,
                              ]
                            : [
                                  picture(files[1], `carried over, ${names[algorithm]}`),
                                  picture(files[2], `the same with the paths, ${names[algorithm]}`),
                              ],
                    ),
                ])}`,
        ),
        table(
            [
                "pair",
                "embeddings",
                "length",
                "energy before",
                "energy after",
                "conformal distortion",
                "area distortion",
                "triangles",
            ],
            pairs.flatMap(({ reference, target, maps }) =>
                maps.map(({ algorithm, length, error, distortion, firstDistortion, triangles }) => [
                    `${reference} → ${target}`,
                    names[algorithm],
                    number(length),
                    ...(error
                        ? ["–", "–", "–", "–", "–"]
                        : [
                              number(firstDistortion.meanEnergy),
                              number(distortion.meanEnergy),
                              number(distortion.meanConformal),
                              number(distortion.meanArea),
                              triangles,
                          ]),
                ]),
            ),
            "Energies and distortions are means over the area of the first target. Grey on the texture: what was on the back of the first target.",
        ),
    ].join("");
}

export function claims(data) {
    const claim = {
        paper: "Maps from greedy embeddings are trapped in a twisted class; those from branch and bound reach the expected result.",
        rule: "On every pair the exact method’s map exists, and the heuristic’s has at least 1.1 times its energy after optimisation, or none can be made.",
        of: ({ pairs }) => {
            const good = pairs.filter(
                ({ maps: [greedy, exact] }) =>
                    !exact.error &&
                    (greedy.error ||
                        greedy.distortion.meanEnergy >= 1.1 * exact.distortion.meanEnergy),
            );
            return [`${good.length} of ${pairs.length} pairs`, judge(good.length === pairs.length)];
        },
    };
    return claimsOf("5.4", [claim], data);
}
