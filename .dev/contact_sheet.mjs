// npm run shapes -- --contact-sheet FILE.png [--vertices N] [--class NAME]: a picture of every
// member of the shape collection, drawn by the system's Chromium.
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { parseArgs } from "node:util";
import { installPackages } from "./build.mjs";
import { StepError, run } from "./run.mjs";
import { ensureSystemPackages } from "./system.mjs";

/** Generates the shapes and draws them; `generator` is the program, paths are relative to `cwd`. */
export async function drawContactSheet(generator, words, cwd) {
    const { values } = parseArgs({
        args: words,
        options: {
            "contact-sheet": { type: "string" },
            vertices: { type: "string", default: "2000" },
            class: { type: "string" },
        },
    });
    await ensureSystemPackages("test");
    await installPackages();
    const folder = mkdtempSync(path.join(tmpdir(), "layout-embedding-"));
    try {
        const which = values.class === undefined ? ["--all"] : ["--class", values.class];
        await run(generator, [...which, "--vertices", values.vertices, "--output", folder]);
        const read = (name) => readFileSync(path.join(folder, name), "utf8");
        const { classes } = JSON.parse(read("index.json"));
        const shapes = classes.map(({ title, members }) => ({
            title,
            members: members.map(({ name, mesh, landmarks }) => ({
                name,
                mesh: read(mesh),
                landmarks: read(landmarks).trim().split("\n").map(Number),
            })),
        }));
        const { chromium } = await import("playwright-core");
        const browser = await chromium.launch({
            executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
            args: ["--headless", "--no-sandbox"],
        });
        try {
            const page = await browser.newPage({ viewport: { width: 1700, height: 900 } });
            await page.evaluate(draw, shapes);
            await page.screenshot({
                path: path.resolve(cwd, values["contact-sheet"]),
                fullPage: true,
            });
        } finally {
            await browser.close();
        }
    } catch (error) {
        throw new StepError(`there is no contact sheet: ${error.message}`);
    } finally {
        rmSync(folder, { recursive: true, force: true });
    }
}

/* global document */

/** Runs in the page: one row per class, faces from back to front, landmarks as dots. */
function draw(classes) {
    const size = 160;
    document.body.style.cssText = "margin: 8px; font: 12px sans-serif; background: white";
    for (const { title, members } of classes) {
        const row = document.createElement("div");
        row.append(title, document.createElement("br"));
        for (const { name, mesh, landmarks } of members) {
            const points = [];
            const faces = [];
            for (const line of mesh.split("\n")) {
                const [kind, ...rest] = line.split(/\s+/);
                if (kind === "v") points.push(rest.map(Number));
                if (kind === "f") faces.push(rest.map((corner) => parseInt(corner, 10) - 1));
            }
            // Seen from the front, a little from the right and from above.
            const turned = points.map(([x, y, z]) => {
                const [c, s] = [Math.cos(0.6), Math.sin(0.6)];
                const depth = s * x + c * z;
                const [d, t] = [Math.cos(0.25), Math.sin(0.25)];
                return [c * x - s * z, d * y - t * depth, t * y + d * depth];
            });
            const range = [0, 1].map((axis) => {
                const values = turned.map((p) => p[axis]);
                return [Math.min(...values), Math.max(...values)];
            });
            const extent = Math.max(...range.map(([low, high]) => high - low));
            const at = (p) =>
                [0, 1].map((axis) => {
                    const middle = (range[axis][0] + range[axis][1]) / 2;
                    const value = (0.92 * size * (p[axis] - middle)) / extent;
                    return size / 2 + (axis === 0 ? value : -value);
                });
            const shaded = faces.map((face) => {
                const [a, b, c] = face.map((v) => turned[v]);
                const u = b.map((x, i) => x - a[i]);
                const v = c.map((x, i) => x - a[i]);
                const n = [
                    u[1] * v[2] - u[2] * v[1],
                    u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0],
                ];
                const length = Math.hypot(...n) || 1;
                const light = (0.4 * n[0] + 0.5 * n[1] + 0.77 * n[2]) / length;
                return { face, depth: a[2] + b[2] + c[2], front: n[2] > 0, light };
            });
            shaded.sort((a, b) => a.depth - b.depth);
            const canvas = document.createElement("canvas");
            canvas.width = canvas.height = size;
            const context = canvas.getContext("2d");
            for (const { face, front, light } of shaded) {
                const shade = Math.round(110 + 130 * Math.max(0, light));
                // The inside of a surface, seen through a hole, is red.
                const color = front ? `rgb(${shade} ${shade} ${shade})` : "rgb(205 120 110)";
                context.fillStyle = context.strokeStyle = color;
                context.lineWidth = 0.5;
                context.beginPath();
                for (const v of face) context.lineTo(...at(turned[v]));
                context.closePath();
                context.fill();
                context.stroke();
            }
            context.fillStyle = "rgb(20 90 200 / 0.7)";
            for (const v of landmarks) context.fillRect(...at(turned[v]).map((x) => x - 1), 2, 2);
            const figure = document.createElement("figure");
            figure.style.cssText = "display: inline-block; margin: 0; text-align: center";
            figure.append(canvas, document.createElement("br"), name);
            row.append(figure);
        }
        document.body.append(row);
    }
}
