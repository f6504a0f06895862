// Fig. 16: layouts with the topology of a disk, in disks and in closed surfaces of genus 0.
import { readFileSync } from "node:fs";
import path from "node:path";
import { readLandmarks, readPositions } from "../bench/generate.mjs";
import { minus, dot } from "../bench/vectors.mjs";
import { embeddingPicture } from "./drawing/picture.mjs";
import { readMember, shippedShapes } from "./problems.mjs";
import { claimsOf, judge } from "./report/claims.mjs";
import { findings, number, percent, picture, pictures, seconds, table } from "./report/html.mjs";
import { openSession, solveAndRecord, withoutHistory } from "./solving.mjs";

export const title = "Disk layouts in disks and in spheres (Fig. 16)";

/** A class with a boundary, and the closed class that its shapes were cut out of. */
const kinds = [
    { open: "face", closed: "bust" },
    { open: "cut_hand", closed: "hand" },
];

export async function run({ pool }) {
    const inputs = kinds.flatMap((kind) => [0, 1].map((member) => ({ ...kind, member })));
    return { cases: (await pool.all("disks", "embed", inputs)).flat() };
}

export const tasks = {
    /** The disk layout of the first open member in the given open and closed members. */
    async embed({ open, closed, member }) {
        const shapes = shippedShapes();
        const [openClass, closedClass] = [open, closed].map((name) =>
            shapes.find((shape) => shape.name === name),
        );
        const template = readMember(openClass.members[0]);
        const problems = [
            {
                kind: "disk",
                shape: openClass.members[member],
                ...readMember(openClass.members[member]),
            },
            {
                kind: "closed",
                shape: closedClass.members[member],
                target: readMember(closedClass.members[member]).target,
                landmarks: landmarksOnClosed(openClass, closedClass, member),
            },
        ];
        const cases = [];
        for (const { kind, shape, target, landmarks } of problems) {
            const session = await openSession({ template, target, landmarks });
            const { result, record } = await solveAndRecord(session, {
                gap: 0,
                workLimit: 20_000_000,
            });
            cases.push({
                kind,
                title: kind === "disk" ? openClass.title : closedClass.title,
                target: shape.name,
                layoutEdges: result.edges.length,
                ...withoutHistory(record),
                picture:
                    result.refined === null
                        ? null
                        : embeddingPicture(`disks-${kind}-${open}-${shape.name}`, result, {
                              view: { direction: [0.35, 0.1, 0.95], up: [0, 1, 0] },
                          }),
            });
        }
        return cases;
    },
};

/**
 * Landmarks of the open class on a closed member, by name; those that the closed class does not
 * have lie at the vertex nearest to where the open member of the same number has them.
 */
function landmarksOnClosed(openClass, closedClass, member) {
    const namesOf = ({ members: [{ folder }], landmarkNames }) =>
        JSON.parse(readFileSync(path.join(folder, landmarkNames), "utf8")).landmarks;
    const [openNames, closedNames] = [openClass, closedClass].map(namesOf);
    const [openFiles, closedFiles] = [openClass, closedClass].map(({ members }) => members[member]);
    const at = ({ folder }, file) => path.join(folder, file);
    const openPositions = readPositions(at(openFiles, openFiles.mesh));
    const openLandmarks = readLandmarks(at(openFiles, openFiles.landmarks));
    const closedPositions = readPositions(at(closedFiles, closedFiles.mesh));
    const closedLandmarks = readLandmarks(at(closedFiles, closedFiles.landmarks));
    return openNames.map((name, i) => {
        const known = closedNames.indexOf(name);
        return known >= 0
            ? closedLandmarks[known]
            : nearest(closedPositions, openPositions[openLandmarks[i]]);
    });
}

function nearest(positions, place) {
    const distances = positions.map((p) => dot(minus(p, place), minus(p, place)));
    return distances.indexOf(Math.min(...distances));
}

const isFound = ({ cost }) => cost !== null;

export function section({ cases }) {
    const found = cases.filter(isFound);
    return [
        findings(
            "Disk-topology layouts (face, hand) can be embedded into targets of disk topology or of genus 0.",
            `${found.length} of ${cases.length} embedded, ${found.filter(({ gap }) => gap === 0).length} with a proof that nothing shorter exists. In a closed target what lies outside the layout is one more patch (grey).`,
        ),
        pictures(
            found.map(({ kind, title: shown, target, picture: file }) =>
                picture(
                    file,
                    `${kind === "disk" ? "in a disk" : "in a closed surface"}: ${shown}, “${target}”`,
                ),
            ),
        ),
        table(
            ["target", "topology", "layout edges", "length", "gap", "CPU time"],
            cases.map(({ title: shown, target, kind, layoutEdges, cost, gap, cpuSearch }) => [
                `${shown}, “${target}”`,
                kind === "disk" ? "disk" : "sphere",
                layoutEdges,
                number(cost),
                percent(gap, 2),
                seconds(cpuSearch),
            ]),
        ),
    ].join("");
}

export function claims(data) {
    const claim = {
        paper: "Disk-topology layouts can be embedded into targets of disk topology and of genus 0 (Fig. 16).",
        rule: "All are embedded; passed if all are also proved optimal.",
        of: ({ cases }) => {
            const found = cases.filter(isFound);
            const proved = found.filter(({ gap }) => gap === 0);
            return [
                `${found.length} of ${cases.length}, ${proved.length} proved`,
                judge(found.length === cases.length, proved.length === cases.length),
            ];
        },
    };
    return claimsOf("6", [claim], data);
}
