// The packed package on the pages of its users, as its README has them: in a plain script from a
// static folder, and bundled by Vite, in a worker and with the module as text.
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { embed } from "layout-embedding";
import { chromium, type Browser } from "playwright-core";
import { build, preview, type PreviewServer } from "vite";
import { afterAll, beforeAll, expect, test, vi } from "vitest";
import { file, obj, octahedron, sphere } from "../node/meshes.js";
import { example, installed, packed } from "../node/packing.js";
import { browserArguments, executablePath, patience } from "./browser.js";

vi.setConfig({ testTimeout: patience, hookTimeout: patience });
const meshes = { layout: octahedron, target: sphere(2) };
const folder = mkdtempSync(path.join(tmpdir(), "layout-embedding-"));
let browser: Browser;
let server: PreviewServer;
let user: string;
beforeAll(async () => {
    user = await installed(await packed(folder), folder);
    server = await preview({
        root: folder,
        logLevel: "warn",
        build: { outDir: path.basename(user) },
        preview: { host: "127.0.0.1", port: 0, open: false },
    });
    browser = await chromium.launch({ executablePath, args: browserArguments });
});
afterAll(async () => {
    await browser.close();
    await server.close();
    rmSync(folder, { recursive: true, force: true });
});

/** A page in a folder of its own, with the two meshes beside it. */
function writePage(name: string, html: string, scripts: Record<string, string> = {}): void {
    mkdirSync(path.join(user, name));
    const files = { "index.html": `<!doctype html><title></title>${html}`, ...scripts };
    for (const [file, text] of Object.entries(files))
        writeFileSync(path.join(user, name, file), text);
    for (const [role, mesh] of Object.entries(meshes))
        writeFileSync(path.join(user, name, `${role}.obj`), obj(mesh));
}

/** A page with one script, bundled by Vite into a folder of its own, and the meshes. */
async function bundlePage(name: string, script: string): Promise<void> {
    writePage(`${name}-source`, '<script type="module" src="./script.js"></script>', {
        "script.js": script,
    });
    writePage(name, "");
    await build({
        root: path.join(user, `${name}-source`),
        logLevel: "error",
        base: "./",
        build: { outDir: `../${name}`, target: "es2022" },
        worker: { format: "es" },
    });
}

/** Opens a page; what it puts into its title in the end, and what it asked for. */
async function titleOf(name: string) {
    const page = await browser.newPage();
    const requests: string[] = [];
    const complaints: string[] = [];
    page.on("request", (request) => requests.push(request.url()));
    page.on("pageerror", (error) => complaints.push(error.message));
    await page.goto(`${server.resolvedUrls!.local[0]}${name}/index.html`);
    await page.waitForFunction(() => document.title !== "", undefined, { timeout: patience });
    const title = await page.title();
    await page.close();
    expect(complaints).toEqual([]);
    return { title, requests };
}

/** What the same embedding is in Node. */
async function inNode(): Promise<string> {
    const { status, cost } = await embed({
        layout: file(meshes.layout, "layout.obj"),
        target: file(meshes.target, "target.obj"),
    });
    return `${status}, ${cost}`;
}

test("a_plain_script_embeds_from_a_static_folder", async () => {
    // The page lies beside the folder of the package.
    const html = example("html", "embed(").replaceAll("./node_modules", "../node_modules");
    writePage("plain", html);
    expect((await titleOf("plain")).title).toBe(await inNode());
});

test("a_page_bundled_by_vite_embeds_in_a_worker", async () => {
    await bundlePage("bundled", example("js", "worker.terminate();\ndocument"));
    const { title, requests } = await titleOf("bundled");
    expect(title).toBe(await inNode());
    expect(requests.filter((url) => /node_modules/.test(url))).toEqual([]);
    expect(requests.filter((url) => /\.wasm$/.test(url))).toHaveLength(1);
});

test("a_page_with_the_module_as_text_asks_for_no_other_file", async () => {
    const embedding = example("html", "embed(").replace(/<\/?script.*>|^ *import.*$/gm, "");
    await bundlePage("text", example("js", "coreBytes") + embedding);
    const { title, requests } = await titleOf("text");
    expect(title).toBe(await inNode());
    expect(requests.filter((url) => !/\.(html|js|obj|ico)$/.test(url))).toEqual([]);
});
