// A Vitest reporter that writes what the summary of `npm test` needs: each test with its state and
// message, and errors that belong to no test. Vitest's own JSON leaves out why a test was skipped.
import { mkdirSync, writeFileSync } from "node:fs";
import path from "node:path";

export default class SummaryReporter {
    onTestRunEnd(modules, unhandledErrors) {
        const tests = [];
        const errors = unhandledErrors.map(describe);
        for (const module of modules) {
            errors.push(
                ...module.errors().map((e) => `${module.relativeModuleId}: ${describe(e)}`),
            );
            for (const suite of module.children.allSuites()) {
                errors.push(...suite.errors().map((e) => `${suite.fullName}: ${describe(e)}`));
            }
            for (const test of module.children.allTests()) {
                const result = test.result();
                tests.push({
                    name: `${module.relativeModuleId} > ${test.fullName}`,
                    state: result.state,
                    message:
                        result.state === "skipped"
                            ? (result.note ?? "")
                            : (result.errors ?? []).map(describe).join("\n"),
                });
            }
        }
        const file = process.env.LAYOUT_EMBEDDING_TEST_REPORT;
        mkdirSync(path.dirname(file), { recursive: true });
        writeFileSync(file, JSON.stringify({ tests, errors }));
    }
}

function describe(error) {
    return `${error.message ?? error}${error.diff ? `\n${error.diff}` : ""}`;
}
