// Every kind of bad input through the page: its code, what to do, and the work goes on.
import { expect, test } from "vitest";
import { badInputs, filesOf, type BadInput } from "../node/bad_inputs.js";
import { textFile, usePage } from "./browser.js";

const opened = usePage();
type Role = "layout" | "target" | "landmarks";

/** Opens files one after the other, until one of them is refused. */
async function open(bad: BadInput, roles: readonly Role[]): Promise<void> {
    const { page } = opened();
    for (const role of roles) {
        const { name, text } = filesOf(bad)[role];
        await page.setInputFiles(`#${role}-file`, textFile(`${bad.name}-${name}`, text));
        await page.waitForFunction(
            ([slot, file]) =>
                document.querySelector(".problem") !== null ||
                document.getElementById(`${slot}-name`)?.textContent === file,
            [role, `${bad.name}-${name}`],
        );
    }
}

test("every_bad_input_is_shown_with_its_code_and_advice", async () => {
    const { page } = opened();
    // The page first reads without repairs, and offers them.
    const all = ["layout", "target", "landmarks"] as const;
    await open({ name: "good", code: "none" }, ["layout", "target"]);
    for (const bad of badInputs.filter(({ repair }) => repair !== true)) {
        await open(
            bad,
            all.filter((role) => bad[role] !== undefined),
        );
        const problem = page.locator(".problem").first();
        await problem.waitFor();
        expect(await problem.locator("p code").first().textContent(), bad.name).toBe(bad.code);
        for (const part of [".cause", ".advice"])
            expect(await problem.locator(part).textContent(), bad.name).toMatch(/\S/);
        while ((await page.locator(".problem").count()) > 0)
            await page
                .getByRole("button", { name: /^Dismiss/ })
                .first()
                .click();
    }
});
