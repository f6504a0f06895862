import axe from "axe-core";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { solved, textFile, untilStatus, useBrowser } from "./browser.js";

const open = useBrowser();

/** Rules that the page breaks right now, with the elements concerned. */
async function violations(page: Page): Promise<string[]> {
    await page.evaluate(axe.source);
    const { violations: found } = await page.evaluate(() =>
        (globalThis as unknown as { axe: typeof axe }).axe.run(),
    );
    return found.map((rule) => `${rule.id}: ${rule.nodes.map((node) => node.html).join(" ")}`);
}

test.for([
    ["light", { colorScheme: "light" }],
    ["dark", { colorScheme: "dark" }],
    ["phone", { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true }],
] as const)("axe_finds_nothing_to_object_to: %s", async ([, options]) => {
    const { page, close } = await open(options);
    await untilStatus(page, solved);
    await page.locator("details").evaluateAll((all) => {
        for (const details of all) (details as HTMLDetailsElement).open = true;
    });
    expect(await violations(page)).toEqual([]);
    await page.setInputFiles("#target-file", textFile("empty.obj", ""));
    await page.locator(".problem").waitFor();
    expect(await violations(page)).toEqual([]);
    await page.click("#help-button");
    expect(await violations(page)).toEqual([]);
    await close();
});

test("every_control_has_a_name", async () => {
    const { page, close } = await open();
    await untilStatus(page, solved);
    const snapshot = await page.locator("body").ariaSnapshot();
    const nameless = snapshot
        .split("\n")
        .filter((line) =>
            /^\s*- (button|checkbox|combobox|spinbutton|link|textbox)(?! ")/.test(line),
        );
    expect(nameless).toEqual([]);
    await close();
});

test("on_a_phone_nothing_is_wider_than_the_screen", async () => {
    const { page, close } = await open({
        viewport: { width: 360, height: 740 },
        isMobile: true,
        hasTouch: true,
    });
    await untilStatus(page, solved);
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(
        360,
    );
    await close();
});
