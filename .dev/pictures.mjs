// npm run pictures -- [--all]: the gallery's pictures, taken by the page itself of each solved shape and
// example, with a transparent background, in web/public/shapes. Without --all only those that are missing.
import { existsSync, mkdirSync, writeFileSync } from "node:fs";
import path from "node:path";
import { chromium } from "playwright-core";
import { preview } from "vite";
import { buildPackage, buildPage, installPackages } from "./build.mjs";
import { main, root, say } from "./run.mjs";
import { ensureSystemPackages } from "./system.mjs";

const folder = path.join(root, "web/public/shapes");
const examples = ["beast", "pebble", "knot"];

await main(async () => {
    await ensureSystemPackages("wasm", "test");
    await installPackages();
    await buildPackage();
    await buildPage();
    const server = await preview({
        root: path.join(root, "web"),
        logLevel: "warn",
        preview: { host: "127.0.0.1", port: 0, open: false },
    });
    const browser = await chromium.launch({
        executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
        args: ["--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader"],
    });
    try {
        const url = server.resolvedUrls.local[0];
        const { classes } = await (await fetch(new URL("shapes/index.json", url))).json();
        const shapes = classes.flatMap(({ name, members }) =>
            members.map((member) => ({
                hash: `shape=${name}/${member.name}`,
                file: `${name}/${member.name}`,
            })),
        );
        for (const name of examples) {
            shapes.push({ hash: `example=${name}`, file: `examples/${name}` });
        }
        for (const { hash, file } of shapes) {
            const out = path.join(folder, `${file}.webp`);
            if (existsSync(out) && !process.argv.includes("--all")) {
                continue;
            }
            const bytes = await pictureOf(browser, `${url}#${hash}`);
            mkdirSync(path.dirname(out), { recursive: true });
            writeFileSync(out, bytes);
            say(`${file}.webp: ${bytes.length} bytes`);
        }
    } finally {
        await browser.close();
        await server.close();
    }
});

/** The target's view of a solved page, without background and landmarks. */
async function pictureOf(browser, address) {
    const page = await browser.newPage({
        viewport: { width: 1184, height: 740 },
        colorScheme: "light",
    });
    await page.goto(address);
    await page.waitForFunction(
        () => /^(Solved|Stopped)/.test(document.getElementById("status").textContent),
        null,
        { timeout: 120_000 },
    );
    await page.uncheck("#show-layout");
    await page.uncheck("#show-dots");
    await page.click("#fit-view");
    const canvas = page.locator("#target-view canvas");
    const pictures = [];
    for (const color of ["#000000", "#ffffff"]) {
        await page.evaluate((background) => {
            document.documentElement.style.setProperty("--view-background", background);
            const theme = document.getElementById("theme");
            theme.value = theme.value === "light" ? "system" : "light";
            theme.dispatchEvent(new Event("change"));
            for (const hidden of document.querySelectorAll("#target-view figcaption"))
                hidden.remove();
        }, color);
        await page.evaluate(
            () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))),
        );
        pictures.push((await canvas.screenshot()).toString("base64"));
    }
    const encoded = await page.evaluate(async ([black, white]) => {
        const pixels = async (source) => {
            const image = new Image();
            image.src = `data:image/png;base64,${source}`;
            await image.decode();
            const area = document.createElement("canvas");
            // Four by three, out of the middle.
            const height = Math.min(image.height, (3 / 4) * image.width);
            const width = (4 / 3) * height;
            [area.width, area.height] = [2 * 320, 2 * 240];
            const context = area.getContext("2d");
            context.drawImage(
                image,
                (image.width - width) / 2,
                (image.height - height) / 2,
                width,
                height,
                0,
                0,
                area.width,
                area.height,
            );
            return context.getImageData(0, 0, area.width, area.height);
        };
        const [onBlack, onWhite] = [await pixels(black), await pixels(white)];
        // A pixel is c = colour * alpha + background * (1 - alpha): two backgrounds give both.
        for (let i = 0; i < onBlack.data.length; i += 4) {
            const alpha = 1 - (onWhite.data[i + 1] - onBlack.data[i + 1]) / 255;
            for (let channel = 0; channel < 3; ++channel)
                onBlack.data[i + channel] = alpha > 0 ? onBlack.data[i + channel] / alpha : 0;
            onBlack.data[i + 3] = 255 * alpha;
        }
        const large = document.createElement("canvas");
        [large.width, large.height] = [onBlack.width, onBlack.height];
        large.getContext("2d").putImageData(onBlack, 0, 0);
        const small = document.createElement("canvas");
        [small.width, small.height] = [320, 240];
        const context = small.getContext("2d");
        context.imageSmoothingQuality = "high";
        context.drawImage(large, 0, 0, small.width, small.height);
        return small.toDataURL("image/webp", 0.82).split(",")[1];
    }, pictures);
    await page.close();
    return Buffer.from(encoded, "base64");
}
