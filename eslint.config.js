import js from "@eslint/js";
import globals from "globals";
import tseslint from "typescript-eslint";

export default tseslint.config(
    { ignores: ["**/dist/", "**/node_modules/", "build/", "bench-results/"] },
    js.configs.recommended,
    {
        files: ["**/*.{js,mjs}"],
        languageOptions: { globals: globals.node },
    },
    {
        // Parts of it run in a page.
        files: [".dev/pictures.mjs"],
        languageOptions: { globals: globals.browser },
    },
    {
        files: ["**/*.ts"],
        extends: [tseslint.configs.recommendedTypeChecked],
        languageOptions: {
            parserOptions: { projectService: true, tsconfigRootDir: import.meta.dirname },
        },
        rules: {
            "@typescript-eslint/consistent-type-imports": "error",
            "@typescript-eslint/switch-exhaustiveness-check": [
                "error",
                { considerDefaultExhaustiveForUnions: true },
            ],
            // Node's test functions and the like return promises that the runner awaits.
            "@typescript-eslint/no-unused-vars": ["error", { argsIgnorePattern: "^_" }],
        },
    },
    { rules: { eqeqeq: "error", "no-console": "off", "prefer-const": "error" } },
);
