// Fails if the last `npm test` skipped tests for missing data although the data folder is there.
// A test says why it is skipped; one without a reason is held against it.
import { existsSync, readFileSync } from "node:fs";
import path from "node:path";
import { main, root } from "./run.mjs";

await main(() => {
    const data = process.env.LAYOUT_EMBEDDING_DATA ?? path.join(root, "../shared");
    if (!existsSync(data)) {
        return 0;
    }
    const parts = JSON.parse(
        readFileSync(path.join(root, "build/test-results/summary.json"), "utf8"),
    );
    const suspects = parts
        .flatMap(({ tests }) => tests)
        .filter(({ state, message }) => state === "skipped" && /^$|data\b|shared/i.test(message));
    if (suspects.length > 0) {
        console.error(`error: tests were skipped for missing data, but ${data} is there:`);
        for (const { name, message } of suspects) {
            console.error(`  ${name}: ${message || "no reason given"}`);
        }
    }
    return suspects.length > 0 ? 1 : 0;
});
