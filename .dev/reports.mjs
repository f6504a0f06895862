// Reads what CTest and Vitest report about their tests, and prints the summary of `npm test`.
import { existsSync, readFileSync } from "node:fs";
import { stripVTControlCharacters } from "node:util";

/**
 * One part of the tests: `tests` holds { name, state, message } with state "passed", "failed" or
 * "skipped"; `errors` are failures that belong to no single test, a crash for example.
 */

/**
 * The tests in a JUnit file written by `ctest --output-junit`. One CTest test may be a process that
 * runs many tests of GoogleTest: what these did is read from its log.
 */
export function readCtest(file) {
    if (!existsSync(file)) {
        return { tests: [], errors: ["CTest wrote no report"] };
    }
    const xml = readFileSync(file, "utf8");
    const tests = [...xml.matchAll(/<testcase\b([^>]*?)(?:\/>|>([\s\S]*?)<\/testcase>)/g)].flatMap(
        ([, attributes, content = ""]) => {
            const log = unescapeXml(
                /<system-out>([\s\S]*?)<\/system-out>/.exec(content)?.[1] ?? "",
            );
            const state = ctestState(attribute(attributes, "status"), content);
            const inside = testsInLog(log);
            const told = inside.some((test) => test.state === "failed");
            if (inside.length > 0 && (state !== "failed" || told)) {
                return inside;
            }
            // A process may fail without any of its tests, for memory it has leaked for example.
            const name = attribute(attributes, "name");
            return [...inside, { name, state, message: digest(state, log, content) }];
        },
    );
    return { tests, errors: [] };
}

/** The tests in a log of GoogleTest; one that began and never ended has failed. */
function testsInLog(log) {
    return log
        .split(/^\[ RUN {6}\] /m)
        .slice(1)
        .map((part) => {
            const [name] = part.split("\n", 1);
            const end = /^\[ *(OK|SKIPPED|FAILED) *\] .*$/m.exec(part);
            const state = { OK: "passed", SKIPPED: "skipped" }[end?.[1]] ?? "failed";
            const text = part.slice(name.length + 1, end?.index);
            return { name, state, message: digest(state, text, "") };
        });
}

function ctestState(status, content) {
    if (status === "run") {
        return "passed";
    }
    // "notrun" is also what CTest says of a test whose program is missing: that is a failure.
    const why = attribute(/<skipped\b([^>]*)>/.exec(content)?.[1] ?? "", "message");
    return status === "disabled" || why.startsWith("SKIP_") ? "skipped" : "failed";
}

/** What a test's log says about its failure, or the reason it was skipped. */
function digest(state, log, content) {
    if (state === "passed") {
        return "";
    }
    const lines = log
        .split("\n")
        .filter((line) => !/^(Running main|Note: Google|\[[ =-]| ?\d+ FAILED TESTS?$)/.test(line));
    if (state === "skipped") {
        // GoogleTest prints "file:line: Skipped" and then the message.
        const place = lines.findIndex((line) => /: Skipped$/.test(line));
        return lines
            .slice(place + 1)
            .join(" ")
            .trim();
    }
    // A fuzzer or sanitizer talks for long before it comes to the point.
    const point = lines.findIndex((line) => /ERROR: |runtime error: /.test(line));
    const reason = attribute(/<failure\b([^>]*)>/.exec(content)?.[1] ?? "", "message");
    return (
        shorten(lines.slice(Math.max(point, 0)).join("\n")) ||
        reason ||
        "it crashed or was stopped before it reported anything"
    );
}

/** The tests in a file written by vitest_reporter.mjs. */
export function readVitest(file) {
    if (!existsSync(file)) {
        return { tests: [], errors: ["Vitest wrote no report"] };
    }
    const { tests, errors } = JSON.parse(readFileSync(file, "utf8"));
    return {
        tests: tests.map(({ name, state, message }) => ({
            name,
            // A test left pending is one that never came to its end.
            state: state === "pending" ? "failed" : state,
            message: shorten(message),
        })),
        errors,
    };
}

/**
 * What is wrong with a part beyond its failed tests. An exit code other than 0 without a failed
 * test, and a part that ran no test at all, are failures too.
 */
export function problemsOf({ tests, errors, exitCode }) {
    const problems = [...errors];
    const ran = tests.some(({ state }) => state !== "skipped");
    if (exitCode !== 0 && problems.length === 0 && !tests.some(({ state }) => state === "failed")) {
        problems.push(`the test run ended with code ${exitCode}`);
    }
    if (!ran && problems.length === 0) {
        problems.push("no test ran");
    }
    return problems;
}

/** Prints the parts' counts, then failures and skips by name, then the totals as the last line. */
export function printSummary(parts) {
    const total = { passed: 0, failed: 0, skipped: 0 };
    const rows = parts.map((part) => {
        const count = { passed: 0, failed: 0, skipped: 0 };
        for (const { state } of part.tests) {
            count[state] += 1;
            total[state] += 1;
        }
        // What belongs to no test still has to be seen in the counts.
        const problems = problemsOf(part);
        count.failed += problems.length;
        total.failed += problems.length;
        return { part, count, problems };
    });
    const width = Math.max(...parts.map(({ name }) => name.length));
    console.log("\nSummary");
    for (const { part, count } of rows) {
        console.log(
            `  ${part.name.padEnd(width)}  ${count.passed} passed, ${count.failed} failed, ` +
                `${count.skipped} skipped (${part.seconds.toFixed(1)} s)`,
        );
    }
    for (const { part, problems } of rows) {
        for (const problem of problems) {
            console.log(`\nFAILED  ${part.name}\n${indent(problem)}`);
        }
        for (const test of part.tests.filter(({ state }) => state === "failed")) {
            console.log(`\nFAILED  ${part.name}: ${test.name}\n${indent(test.message)}`);
        }
    }
    const skipped = rows.flatMap(({ part }) =>
        part.tests
            .filter(({ state }) => state === "skipped")
            .map(({ name, message }) => `  ${part.name}: ${name}: ${message || "no reason given"}`),
    );
    if (skipped.length > 0) {
        console.log(`\nSkipped\n${skipped.join("\n")}`);
    }
    console.log(`\n${total.passed} passed, ${total.failed} failed, ${total.skipped} skipped`);
    return total;
}

function attribute(text, name) {
    return unescapeXml(new RegExp(`\\b${name}="([^"]*)"`).exec(text)?.[1] ?? "");
}

function unescapeXml(text) {
    const names = { lt: "<", gt: ">", quot: '"', apos: "'", amp: "&" };
    return text.replace(/&(lt|gt|quot|apos|amp|#\d+|#x[\da-f]+);/gi, (_, name) =>
        name[0] === "#"
            ? String.fromCodePoint(Number(name[1] === "x" ? `0${name.slice(1)}` : name.slice(1)))
            : names[name],
    );
}

function shorten(text, lines = 30) {
    const all = stripVTControlCharacters(text).trim().split("\n");
    return all.length <= lines
        ? all.join("\n")
        : [...all.slice(0, lines), `… ${all.length - lines} more lines`].join("\n");
}

function indent(text) {
    return text.replace(/^/gm, "    ");
}
