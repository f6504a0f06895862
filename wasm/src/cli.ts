#!/usr/bin/env node
// The command line, `layout-embedding`: finds the command, runs it, and turns its outcome into
// output and an exit code. Node only.
import { parseCommand, wantsJson } from "./cli/arguments.js";
import { runBatch } from "./cli/batch_command.js";
import { runCheck } from "./cli/check_command.js";
import { runConvert } from "./cli/convert_command.js";
import { runEmbed } from "./cli/embed_command.js";
import { helpText } from "./cli/help.js";
import { runLayout } from "./cli/layout_command.js";
import { runMap } from "./cli/map_command.js";
import { exitCodeOf, type Outcome } from "./cli/outcome.js";
import { asLayoutError } from "./errors.js";
import { version } from "./index.js";

async function run(args: string[]): Promise<Outcome> {
    const command = parseCommand(args);
    switch (command.name) {
        case "help":
            return { exitCode: 0, text: helpText, document: { help: helpText } };
        case "version": {
            const solver = await version();
            return { exitCode: 0, text: solver, document: { version: solver } };
        }
        case "embed":
            return runEmbed(command);
        case "check":
            return runCheck(command);
        case "layout":
            return runLayout(command);
        case "convert":
            return runConvert(command);
        case "map":
            return runMap(command);
        case "batch":
            return runBatch(command);
    }
}

/** Runs to the end; never throws. */
async function main(): Promise<void> {
    // Whoever reads the output may stop early: `layout-embedding ... | head`.
    process.stdout.on("error", () => undefined);
    const args = process.argv.slice(2);
    const json = wantsJson(args);
    try {
        const outcome = await run(args);
        process.exitCode = outcome.exitCode;
        const output = json ? JSON.stringify(outcome.document) : outcome.text;
        if (output !== "") {
            process.stdout.write(`${output}\n`);
        }
    } catch (reason) {
        const { code, message, details } = asLayoutError(reason);
        process.exitCode = exitCodeOf(code);
        if (json) {
            process.stdout.write(`${JSON.stringify({ error: { code, message, details } })}\n`);
        } else {
            process.stderr.write(`error: ${message}\n`);
        }
    }
}

await main();
