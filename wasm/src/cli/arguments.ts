// From words on the command line to typed commands; throws `usage` or `invalidOption`.
import { parseArgs, type ParseArgsConfig } from "node:util";
import { javaScriptError, LayoutError } from "../errors.js";
import { jobOptions } from "../job.js";
import type { Algorithm, PathShape, SolveOptions } from "../types.js";

export interface EmbedCommand {
    name: "embed";
    layout: string;
    target: string;
    landmarks: string | null;
    repair: boolean;
    output: string | null;
    quiet: boolean;
    json: boolean;
    solve: SolveOptions;
}

export interface CheckCommand {
    name: "check";
    folder: string;
    layout: string;
    target: string;
    landmarks: string | null;
    repair: boolean;
}

export interface LayoutCommand {
    name: "layout";
    target: string;
    landmarks: string;
    output: string;
    quads: boolean;
    repair: boolean;
    quiet: boolean;
    json: boolean;
}

export type Command =
    { name: "help" } | { name: "version" } | EmbedCommand | CheckCommand | LayoutCommand;

const commonOptions = {
    help: { type: "boolean" },
    landmarks: { type: "string" },
    repair: { type: "boolean" },
    json: { type: "boolean" },
} as const satisfies ParseArgsConfig["options"];

const embedOptions = {
    ...commonOptions,
    algorithm: { type: "string" },
    gap: { type: "string" },
    "time-limit": { type: "string" },
    "work-limit": { type: "string" },
    "memory-limit": { type: "string" },
    seed: { type: "string" },
    shape: { type: "string" },
    output: { type: "string" },
    quiet: { type: "boolean" },
} as const satisfies ParseArgsConfig["options"];

const layoutOptions = {
    ...commonOptions,
    output: { type: "string" },
    quads: { type: "boolean" },
    quiet: { type: "boolean" },
} as const satisfies ParseArgsConfig["options"];

/** Whether output is to be JSON, also where the rest of the line is wrong. */
export function wantsJson(args: string[]): boolean {
    const end = args.indexOf("--");
    return (end < 0 ? args : args.slice(0, end)).includes("--json");
}

export function parseCommand(args: string[]): Command {
    const [name, ...rest] = args;
    if (name === "--json" && rest[0] !== undefined) {
        // The one option that may come first, too.
        return parseCommand([rest[0], name, ...rest.slice(1)]);
    }
    switch (name) {
        case "embed":
            return parseEmbed(rest);
        case "check":
            return parseCheck(rest);
        case "layout":
            return parseLayout(rest);
        case "--help":
        case "-h":
        case "help":
            return { name: "help" };
        case "--version":
            return { name: "version" };
        case undefined:
        case "--json":
            throw javaScriptError("usage", "no command was given");
        default:
            throw javaScriptError("usage", `there is no command ${name}`);
    }
}

function parseEmbed(args: string[]): Command {
    const { values, positionals } = parsed({ args, options: embedOptions, allowPositionals: true });
    if (values.help) {
        return { name: "help" };
    }
    const [layout, target] = paths(positionals, ["LAYOUT", "TARGET"]);
    const solve: SolveOptions = {
        ...given("algorithm", values.algorithm as Algorithm | undefined),
        ...given("gap", number("--gap", values.gap)),
        ...given("timeLimit", number("--time-limit", values["time-limit"])),
        ...given("workLimit", number("--work-limit", values["work-limit"])),
        ...given("memoryLimit", number("--memory-limit", values["memory-limit"], 1e6)),
        ...given("shape", values.shape as PathShape | undefined),
        ...given("seed", number("--seed", values.seed)),
    };
    // Wrong values are found before any file is read.
    jobOptions(solve);
    return {
        name: "embed",
        layout,
        target,
        landmarks: values.landmarks ?? null,
        repair: values.repair === true,
        output: values.output ?? null,
        quiet: values.quiet === true,
        json: values.json === true,
        solve,
    };
}

function parseCheck(args: string[]): Command {
    const { values, positionals } = parsed({
        args,
        options: commonOptions,
        allowPositionals: true,
    });
    if (values.help) {
        return { name: "help" };
    }
    const [folder, layout, target] = paths(positionals, ["DIR", "LAYOUT", "TARGET"]);
    return {
        name: "check",
        folder,
        layout,
        target,
        landmarks: values.landmarks ?? null,
        repair: values.repair === true,
    };
}

function parseLayout(args: string[]): Command {
    const { values, positionals } = parsed({
        args,
        options: layoutOptions,
        allowPositionals: true,
    });
    if (values.help) {
        return { name: "help" };
    }
    const [target] = paths(positionals, ["TARGET"]);
    return {
        name: "layout",
        target,
        landmarks: needed("--landmarks FILE", values.landmarks),
        output: needed("--output LAYOUT.obj", values.output),
        quads: values.quads === true,
        repair: values.repair === true,
        quiet: values.quiet === true,
        json: values.json === true,
    };
}

/** The value of an option that cannot be left out. */
function needed(option: string, value: string | undefined): string {
    if (value === undefined || value === "") {
        throw javaScriptError("usage", `${option} is missing`);
    }
    return value;
}

/** As parseArgs(), with its errors as one sentence of ours. */
function parsed<T extends ParseArgsConfig>(config: T): ReturnType<typeof parseArgs<T>> {
    try {
        return parseArgs(config);
    } catch (reason) {
        // Node adds advice of several sentences and lines.
        const message = reason instanceof Error ? reason.message : String(reason);
        const sentence = message.split(/\.\s|\n/)[0] ?? message;
        throw javaScriptError("usage", sentence.replace(/\.$/, ""));
    }
}

function paths<const Names extends readonly string[]>(
    positionals: string[],
    names: Names,
): { [K in keyof Names]: string } {
    const missing = names[positionals.length];
    if (missing !== undefined) {
        throw javaScriptError("usage", `${missing} is missing`);
    }
    const extra = positionals[names.length];
    if (extra !== undefined) {
        throw javaScriptError("usage", `${extra} is one file too many`);
    }
    const empty = positionals.indexOf("");
    if (empty >= 0) {
        throw javaScriptError("usage", `${names[empty] ?? ""} is an empty path`);
    }
    return positionals as { [K in keyof Names]: string };
}

/** A number in decimal digits, times `unit`; whether it makes sense is decided elsewhere. */
function number(option: string, text: string | undefined, unit = 1): number | undefined {
    if (text === undefined) {
        return undefined;
    }
    if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(text)) {
        throw new LayoutError("invalidOption", `${option} is "${text}"; give a number.`);
    }
    return Number(text) * unit;
}

/** An object with the one property, or none where the value is undefined. */
function given<Key extends string, Value>(
    key: Key,
    value: Value | undefined,
): { [K in Key]?: Value } {
    return value === undefined ? {} : ({ [key]: value } as { [K in Key]?: Value });
}
