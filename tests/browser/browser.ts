// Opens the built page in the system's Chromium, as a person would, and keeps a record of what a
// page should not do: errors on the console and requests.
import { readFile } from "node:fs/promises";
import { chromium, type Browser, type BrowserContextOptions, type Page } from "playwright-core";
import { afterAll, afterEach, beforeAll, expect, inject, vi } from "vitest";

export const executablePath = process.env["CHROMIUM"] ?? "/usr/bin/chromium";

/** Without a graphics card, and without the browser's own requests. */
export const browserArguments = [
    "--headless",
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
];

/** Large enough for both views; every pixel is drawn without a graphics card. */
const viewport = { width: 1120, height: 720 };

/** A solve on a small machine under load may take its time. */
export const patience = 90_000;

export interface OpenPage {
    page: Page;
    /** Errors and warnings on the console, and uncaught errors. */
    complaints: string[];
    /** Addresses asked for, in order. */
    requests: string[];
    close: () => Promise<void>;
}

/** What a page is opened with: a context, and what follows # in its address. */
export interface OpenOptions extends BrowserContextOptions {
    link?: string;
}

/** One browser per test file; every page gets a context of its own. */
export function useBrowser(): (options?: OpenOptions) => Promise<OpenPage> {
    vi.setConfig({ testTimeout: 2 * patience, hookTimeout: patience });
    let browser: Browser;
    beforeAll(async () => {
        browser = await chromium.launch({ executablePath, args: browserArguments });
    });
    afterAll(() => browser.close());
    return async ({ link, ...options } = {}) => {
        const context = await browser.newContext({
            viewport,
            acceptDownloads: true,
            ...options,
        });
        context.setDefaultTimeout(patience);
        const page = await context.newPage();
        const complaints: string[] = [];
        const requests: string[] = [];
        page.on("console", (message) => {
            // Chromium reports how slow reading pixels back is; that is this test's doing.
            if (["error", "warning"].includes(message.type()) && !/ReadPixels/.test(message.text()))
                complaints.push(message.text());
        });
        page.on("pageerror", (error) => complaints.push(error.message));
        context.on("request", (request) => requests.push(request.url()));
        await page.goto(inject("pageUrl") + (link ? `#${link}` : ""));
        return { page, complaints, requests, close: () => context.close() };
    };
}

/**
 * A page for all tests of a file, one after the other, as one person uses it. Each test has to leave
 * it without complaints.
 */
export function usePage(options: OpenOptions = {}): () => OpenPage {
    const open = useBrowser();
    let opened: OpenPage | null = null;
    beforeAll(async () => {
        opened = await open(options);
        await untilStatus(opened.page, solved);
    });
    afterEach(() => {
        expect(opened?.complaints.splice(0), "complaints of the page").toEqual([]);
    });
    return () => {
        if (!opened) throw new Error("the page is not open");
        return opened;
    };
}

/** Waits until the status says so; fails at once if a problem is shown instead. */
export async function untilStatus(page: Page, pattern: RegExp): Promise<string> {
    await page.waitForFunction(
        (source) =>
            new RegExp(source).test(document.getElementById("status")?.textContent ?? "") ||
            document.querySelector(".problem") !== null,
        pattern.source,
    );
    const status = (await page.textContent("#status")) ?? "";
    const problems = await page.locator(".problem").allTextContents();
    expect(problems, `problems instead of the status ${String(pattern)}`).toEqual([]);
    expect(status).toMatch(pattern);
    return status;
}

/** Any end of a solve with an embedding. */
export const solved = /^(Solved|Stopped at)/;
export const ready = /^Ready to solve/;

/** Chooses a shape or example in the gallery. */
export async function choose(page: Page, title: string): Promise<void> {
    await page.click("#gallery-button");
    await page.locator("#gallery-cards button", { hasText: title }).first().click();
}

/** Waits until the solve of something just chosen is over; `before` is the target's name till then. */
export async function untilSolvedAfter(page: Page, before: string | null): Promise<void> {
    await page.waitForFunction(
        (name) => document.getElementById("target-name")?.textContent !== name,
        before,
    );
    await page.waitForFunction(() =>
        /^\d/.test(document.getElementById("cost")?.textContent ?? ""),
    );
    await untilStatus(page, solved);
}

/** Clicks "Solve" and waits for an embedding. */
export async function solve(page: Page): Promise<void> {
    await page.click("#solve");
    await untilSolved(page);
}

/** Waits until a solve that was just begun is over. */
export async function untilSolved(page: Page): Promise<void> {
    await page.waitForFunction(
        () =>
            document.getElementById("solve")?.textContent === "Solve" &&
            /^\d/.test(document.getElementById("cost")?.textContent ?? ""),
    );
    await untilStatus(page, solved);
}

/** The number that an element shows. */
export async function numberIn(page: Page, selector: string): Promise<number> {
    return Number(((await page.textContent(selector)) ?? "").replace(/[^\d.]/g, ""));
}

/**
 * Moves the pointer over the target until the page says that it is over something like `pattern`,
 * nearest to a point first; returns where that is, relative to the page.
 */
export async function findInTarget(
    page: Page,
    pattern: RegExp,
    around: { x: number; y: number } = { x: 0.5, y: 0.5 },
): Promise<{ x: number; y: number; said: string }> {
    const box = await page.locator("#target-view canvas").boundingBox();
    if (!box) throw new Error("the target is not shown");
    const middle = { x: box.x + around.x * box.width, y: box.y + around.y * box.height };
    const steps = [];
    for (let dx = -8; dx <= 8; ++dx) for (let dy = -8; dy <= 8; ++dy) steps.push({ dx, dy });
    steps.sort((a, b) => Math.hypot(a.dx, a.dy) - Math.hypot(b.dx, b.dy));
    for (const { dx, dy } of steps) {
        const at = { x: middle.x + 9 * dx, y: middle.y + 9 * dy };
        await page.mouse.move(at.x, at.y);
        await frames(page, 1);
        const said = (await page.textContent("#target-hover")) ?? "";
        if (pattern.test(said)) return { ...at, said };
    }
    throw new Error(`there is nothing like ${String(pattern)} there`);
}

/** Lets the page draw. */
export async function frames(page: Page, count = 2): Promise<void> {
    await page.evaluate(async (number) => {
        for (let frame = 0; frame < number; ++frame)
            await new Promise((resolve) => requestAnimationFrame(resolve));
    }, count);
}

/** A file as setInputFiles() takes it. */
export function textFile(name: string, text: string) {
    return { name, mimeType: "text/plain", buffer: Buffer.from(text) };
}

/** Drops files on the page, as from the desktop. */
export async function drop(page: Page, files: { name: string; text: string }[]): Promise<void> {
    const transfer = await page.evaluateHandle((list) => {
        const data = new DataTransfer();
        for (const { name, text } of list) data.items.add(new File([text], name));
        return data;
    }, files);
    for (const type of ["dragenter", "dragover", "drop"])
        await page.dispatchEvent("body", type, { dataTransfer: transfer });
    await transfer.dispose();
}

/** What a button of the page downloads. */
export async function downloaded(page: Page, trigger: () => Promise<void>): Promise<Buffer> {
    const [download] = await Promise.all([page.waitForEvent("download"), trigger()]);
    return readFile(await download.path());
}

/** How many pixels of an element's picture have each colour, in steps of 32 per channel. */
export async function colorsOf(page: Page, selector: string): Promise<Map<number, number>> {
    const picture = await page.locator(selector).screenshot();
    const counts = await page.evaluate(async (source) => {
        const image = new Image();
        image.src = `data:image/png;base64,${source}`;
        await image.decode();
        const canvas = document.createElement("canvas");
        canvas.width = image.width;
        canvas.height = image.height;
        const context = canvas.getContext("2d");
        if (!context) return [];
        context.drawImage(image, 0, 0);
        const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
        const found: Record<number, number> = {};
        for (let i = 0; i < data.length; i += 4) {
            const key =
                ((data[i] ?? 0) >> 5) * 64 +
                ((data[i + 1] ?? 0) >> 5) * 8 +
                ((data[i + 2] ?? 0) >> 5);
            found[key] = (found[key] ?? 0) + 1;
        }
        return Object.entries(found);
    }, picture.toString("base64"));
    return new Map(counts.map(([key, count]) => [Number(key), count]));
}
