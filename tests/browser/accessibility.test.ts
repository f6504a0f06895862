import axe from "axe-core";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { solved, textFile, untilStatus, useBrowser, usePage } from "./browser.js";

const opened = usePage({ link: "shape=vase/tulip", colorScheme: "light" });
const open = useBrowser();

interface Scope {
    /** The part of the page that is looked at. */
    readonly within?: string;
    /** Only these rules. */
    readonly rules?: readonly string[];
}

/** Rules that the page breaks right now, with the elements concerned. */
async function violations(page: Page, { within = "html", rules }: Scope = {}): Promise<string[]> {
    await page.evaluate(axe.source);
    const { violations: found } = await page.evaluate(
        ([selector, only]) =>
            (globalThis as unknown as { axe: typeof axe }).axe.run(selector, {
                resultTypes: ["violations"],
                ...(only && { runOnly: only }),
            }),
        [within, rules ? [...rules] : null] as const,
    );
    return found.map((rule) => `${rule.id}: ${rule.nodes.map((node) => node.html).join(" ")}`);
}

async function openAllDetails(page: Page): Promise<void> {
    await page.locator("details").evaluateAll((all) => {
        for (const details of all) (details as HTMLDetailsElement).open = true;
    });
}

/** What depends on the colours. */
const colors = ["color-contrast", "link-in-text-block"];

test("axe_finds_nothing_to_object_to_in_light_and_dark", async () => {
    const { page } = opened();
    await openAllDetails(page);
    // With an edge chosen, and a rule for its route.
    await page.getByRole("button", { name: "Show edge 0", exact: true }).click();
    await page.click("#route-keep");
    expect(await page.isVisible("#routes")).toBe(true);
    expect(await violations(page)).toEqual([]);
    await page.emulateMedia({ colorScheme: "dark" });
    expect(await violations(page, { rules: colors })).toEqual([]);
    await page.emulateMedia({ colorScheme: "light" });
    await page.click("#tab-quads");
    await page.locator("#loop-rows input").first().waitFor();
    expect(await violations(page)).toEqual([]);
    await page.emulateMedia({ colorScheme: "dark" });
    expect(await violations(page, { rules: colors })).toEqual([]);
    await page.emulateMedia({ colorScheme: "light" });
    await page.click("#tab-map");
    await page.click("#map-shapes button");
    await page.locator("#map-figures dd").first().waitFor();
    await page.fill("#map-vertex", "7");
    await page.press("#map-vertex", "Enter");
    expect(await violations(page)).toEqual([]);
    await page.emulateMedia({ colorScheme: "dark" });
    expect(await violations(page, { rules: colors })).toEqual([]);
    await page.emulateMedia({ colorScheme: "light" });
    await page.click("#tab-embedding");
    // With a problem and its place.
    const repeated = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2\n";
    await page.setInputFiles("#target-file", textFile("repeated.obj", repeated));
    await page.locator("#place-view canvas").waitFor();
    expect(await violations(page)).toEqual([]);
    await page.emulateMedia({ colorScheme: "dark" });
    expect(await violations(page, { rules: colors })).toEqual([]);
    for (const dialog of ["help", "gallery", "batch"]) {
        await page.click(`#${dialog}-button`);
        expect(await violations(page, { within: `#${dialog}`, rules: colors })).toEqual([]);
        await page.emulateMedia({ colorScheme: "light" });
        expect(await violations(page, { within: `#${dialog}` })).toEqual([]);
        await page.emulateMedia({ colorScheme: "dark" });
        await page.keyboard.press("Escape");
    }
});

test("every_control_has_a_name", async () => {
    const { page } = opened();
    const snapshot = await page.locator("body").ariaSnapshot();
    const nameless = snapshot
        .split("\n")
        .filter((line) =>
            /^\s*- (button|checkbox|combobox|spinbutton|slider|link|textbox)(?! ")/.test(line),
        );
    expect(nameless).toEqual([]);
});

test("on_a_phone_axe_has_no_objections_and_nothing_is_wider_than_the_screen", async () => {
    const { page, complaints, close } = await open({
        link: "shape=vase/tulip",
        viewport: { width: 360, height: 740 },
        isMobile: true,
        hasTouch: true,
    });
    await untilStatus(page, solved);
    await openAllDetails(page);
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(
        360,
    );
    expect(await violations(page)).toEqual([]);
    for (const [tab, made] of [
        ["quads", "#loop-rows input"],
        ["map", "#map-figures dd"],
    ] as const) {
        await page.click(`#tab-${tab}`);
        if (tab === "map") await page.click("#map-shapes button");
        await page.locator(made).first().waitFor();
        expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(
            360,
        );
        expect(await violations(page)).toEqual([]);
    }
    expect(complaints).toEqual([]);
    await close();
});
