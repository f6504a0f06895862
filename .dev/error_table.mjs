// The table of all error codes, made from what the package itself says; printed when run alone.
import { exitCodeOf } from "../wasm/dist/cli/outcome.js";
import { errorInfos } from "../wasm/dist/index.js";
import { javaScriptErrors } from "../wasm/dist/errors.js";

const capitalised = (clause) => clause[0].toUpperCase() + clause.slice(1);

function table(infos) {
    const rows = infos.map(
        ({ code, meaning, advice }) =>
            `| \`${code}\` | ${capitalised(meaning)} | ${capitalised(advice)} | ${exitCodeOf(code)} |`,
    );
    return [
        "| code | what it means | what to do | exit code |",
        "| --- | --- | --- | --- |",
        ...rows,
    ].join("\n");
}

/** The text of wasm/ERRORS.md. */
export async function errorTable() {
    const all = await errorInfos();
    const fromJavaScript = new Set(javaScriptErrors.map(({ code }) => code));
    const core = all.filter(({ code }) => !fromJavaScript.has(code));
    return `# Errors

Every \`LayoutError\` has one of these codes; its \`message\` says what is wrong, where, and what to
do, and its \`details\` hold the place as numbers. The last column is the exit code of the command
line. \`npm run docs\` makes this file from the code.

## From the core

${table(core)}

## From the package around it

${table(javaScriptErrors)}
`;
}

if (process.argv[1] === import.meta.filename) {
    process.stdout.write(await errorTable());
}
