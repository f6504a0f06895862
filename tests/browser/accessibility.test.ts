import axe from "axe-core";
import type { Page } from "playwright-core";
import { expect, test } from "vitest";
import { solved, textFile, untilSolved, untilStatus, useBrowser, usePage } from "./browser.js";

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

/** Roles that tell nobody anything without a name. */
const named = new Set(
    "application button checkbox combobox dialog figure image link progressbar region slider spinbutton tab tablist tabpanel textbox".split(
        " ",
    ),
);

/** What the browser hands to a screen reader of a role in `named`, but without a name. */
async function namelessNodes(page: Page): Promise<string[]> {
    const client = await page.context().newCDPSession(page);
    const { nodes } = await client.send("Accessibility.getFullAXTree");
    await client.detach();
    const seen = nodes.filter(({ ignored, role }) => !ignored && named.has(String(role?.value)));
    expect(seen.length).toBeGreaterThan(30);
    return seen
        .filter(({ name }) => !name?.value)
        .map(({ role, nodeId }) => `${String(role?.value)} ${nodeId}`);
}

/** Has all live regions that are shown collect what they say; returns what ends that. */
async function listen(page: Page): Promise<() => Promise<string[]>> {
    await page.evaluate(() => {
        const said: string[] = [];
        Object.assign(globalThis, { said });
        for (const region of document.querySelectorAll<HTMLElement>("[role=status], [aria-live]"))
            new MutationObserver(() => {
                const text = region.textContent.trim();
                if (text !== "" && region.checkVisibility()) said.push(text);
            }).observe(region, { childList: true, characterData: true, subtree: true });
    });
    return () => page.evaluate(() => (globalThis as unknown as { said: string[] }).said.splice(0));
}

test("a_screen_reader_gets_names_for_everything_and_each_message_once", async () => {
    const { page, complaints, close } = await open({ link: "shape=vase/tulip" });
    await untilStatus(page, solved);
    const said = await listen(page);
    // An edit says what it did and what came of it, without what holds for a moment only.
    await page.focus("#features");
    await page.keyboard.press("End");
    await untilSolved(page);
    const edit = await said();
    expect(edit[0]).toBe("Along sharp edges paths cost up to 95 % less.");
    expect(edit.at(-1)).toMatch(solved);
    expect(edit.filter((text) => /^(Ready|Done)/.test(text))).toEqual([]);
    // Comparing names each heuristic, says how it ended, and does not say the status again.
    await page.keyboard.press("c");
    await page.locator("#contenders tr").nth(3).waitFor();
    const compared = await said();
    expect(compared.filter((text) => text.startsWith("Trying "))).toHaveLength(4);
    expect(compared.filter((text) => text.startsWith("The longest of 4 heuristics"))).toHaveLength(
        1,
    );
    expect(compared.filter((text) => solved.test(text))).toEqual([]);
    await openAllDetails(page);
    expect(await namelessNodes(page)).toEqual([]);
    await page.click("#tab-quads");
    await page.locator("#loop-rows input").first().waitFor();
    expect(await namelessNodes(page)).toEqual([]);
    await page.click("#tab-map");
    await page.click("#map-shapes button");
    await page.locator("#map-figures dd").first().waitFor();
    expect(await namelessNodes(page)).toEqual([]);
    await said();
    await page.click("#map-stop");
    await page.waitForFunction(() =>
        /partly optimised/.test(document.getElementById("map-status")?.textContent ?? ""),
    );
    expect((await said()).some((text) => /^The partly optimised map is there/.test(text))).toBe(
        true,
    );
    expect(complaints).toEqual([]);
    await close();
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
