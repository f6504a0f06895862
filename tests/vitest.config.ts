// The TypeScript tests: `node` uses the built package, `browser` drives the built page.
import { defineConfig } from "vitest/config";

export default defineConfig({
    test: {
        root: import.meta.dirname,
        // Two cores are all there is on a small machine, and the solver keeps one of them busy.
        maxWorkers: 2,
        testTimeout: 60_000,
        hookTimeout: 60_000,
        projects: [
            { extends: true, test: { name: "node", include: ["node/**/*.test.ts"] } },
            {
                extends: true,
                test: {
                    name: "browser",
                    include: ["browser/**/*.test.ts"],
                    globalSetup: ["browser/serve_page.ts"],
                    fileParallelism: false,
                },
            },
        ],
    },
});
