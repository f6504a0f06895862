import { expect, inject, test } from "vitest";
import { drop, ready, solved, untilStatus, useBrowser } from "./browser.js";
import { ball, cube, toObj } from "./meshes.js";

const open = useBrowser();

test("only_the_pages_own_files_are_asked_for_and_nothing_once_it_has_loaded", async () => {
    const { page, requests, complaints, close } = await open();
    await untilStatus(page, solved);
    const origin = new URL(inject("pageUrl")).origin;
    expect(requests.length).toBeGreaterThan(2);
    expect(requests.filter((url) => new URL(url).origin !== origin)).toEqual([]);

    const loaded = requests.length;
    await drop(page, [
        { name: "cube.obj", text: toObj(cube) },
        { name: "ball.obj", text: toObj(ball(3)) },
    ]);
    await untilStatus(page, ready);
    await page.click("#solve");
    await untilStatus(page, solved);
    const [download] = await Promise.all([
        page.waitForEvent("download"),
        page.click('button[data-file="refined.obj"]'),
    ]);
    expect(download.url()).toMatch(/^blob:/);
    expect(requests.slice(loaded).filter((url) => !url.startsWith("blob:"))).toEqual([]);
    expect(await page.textContent("footer")).toContain("Nothing leaves your browser");
    expect(complaints).toEqual([]);
    await close();
});

test("the_content_security_policy_stops_requests_to_other_places", async () => {
    const { page, close } = await open();
    await untilStatus(page, solved);
    const violated = await page.evaluate(async () => {
        const report = new Promise<string>((resolve) =>
            document.addEventListener("securitypolicyviolation", (event) =>
                resolve(event.effectiveDirective),
            ),
        );
        await fetch("https://example.com/").catch(() => undefined);
        return report;
    });
    expect(violated).toBe("connect-src");
    await close();
});
