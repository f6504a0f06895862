// The table of error codes for users, and that each code of it is provoked by a test.
import { readdirSync, readFileSync } from "node:fs";
import path from "node:path";
import { errorInfos } from "layout-embedding";
import { expect, test } from "vitest";
import { badInputs } from "./bad_inputs.js";
import { runProgram } from "./command.js";

const root = path.resolve(import.meta.dirname, "../..");

test("errors_md_is_what_npm_run_docs_makes", async () => {
    const made = await runProgram(process.execPath, [path.join(root, ".dev/error_table.mjs")]);
    expect(made.stderr).toBe("");
    expect(readFileSync(path.join(root, "wasm/ERRORS.md"), "utf8")).toBe(made.stdout);
});

/**
 * What no input is known to provoke: a mistake in the library; a patch that neither of two ways to
 * map it to the plane can manage; a target that cannot be collapsed onto landmarks that are enough
 * for it (tests with random landmarks allow for that, but it does not happen).
 */
const notProvoked = ["internal", "parametrisationFailed", "templateNotReached"];

/** What the tests of a folder say. */
function textOf(folder: string, pattern: RegExp): string {
    const place = path.join(root, "tests", folder);
    const files = readdirSync(place).filter(
        (name) => pattern.test(name) && !import.meta.filename.endsWith(name),
    );
    return files.map((name) => readFileSync(path.join(place, name), "utf8")).join("\n");
}

test("every_code_is_expected_by_a_test", async () => {
    const core = textOf("core", /_test\.cc$/);
    const scripts = textOf("node", /\.test\.ts$/);
    const inputs = new Set(badInputs.map(({ code }) => code));
    const codes = (await errorInfos()).map(({ code }) => code);
    expect(codes).toEqual(expect.arrayContaining(notProvoked));
    const missing = codes.filter(
        (code) =>
            !notProvoked.includes(code) &&
            !inputs.has(code) &&
            !new RegExp(`ErrorCode::${code}\\b`).test(core) &&
            !new RegExp(`"${code}"`).test(scripts),
    );
    expect(missing).toEqual([]);
});
