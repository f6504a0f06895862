// Serves the built page for all browser tests, on a free port of this machine. A test gets the
// address by inject("pageUrl").
import { fileURLToPath } from "node:url";
import { preview } from "vite";
import type {} from "vitest";
import type { TestProject } from "vitest/node";

declare module "vitest" {
    interface ProvidedContext {
        pageUrl: string;
    }
}

export default async function servePage(project: TestProject): Promise<() => Promise<void>> {
    const server = await preview({
        root: fileURLToPath(new URL("../../web", import.meta.url)),
        logLevel: "warn",
        preview: { host: "127.0.0.1", port: 0, open: false },
    });
    const pageUrl = server.resolvedUrls?.local[0];
    if (pageUrl === undefined) {
        throw new Error("the page could not be served");
    }
    project.provide("pageUrl", pageUrl);
    return () => server.close();
}
