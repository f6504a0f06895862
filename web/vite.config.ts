import { defineConfig } from "vite";

export default defineConfig({
    // Relative addresses: the built page works from any static folder.
    base: "./",
    build: {
        target: "es2022",
        // The content security policy allows no inline data, and a preload helper is not needed.
        assetsInlineLimit: 0,
        modulePreload: { polyfill: false },
        chunkSizeWarningLimit: 900,
        rolldownOptions: {
            output: {
                // three changes less often than the page: a chunk of its own stays in the cache.
                codeSplitting: { groups: [{ name: "three", test: /node_modules[\\/]three/ }] },
            },
        },
    },
    worker: { format: "es" },
    // Its worker and its .wasm are found relative to its own modules.
    optimizeDeps: { exclude: ["layout-embedding"] },
});
