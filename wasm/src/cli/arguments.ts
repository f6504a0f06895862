// From words on the command line to typed commands; throws `usage` or `invalidOption`.
import { parseArgs, type ParseArgsConfig } from "node:util";
import { javaScriptError, LayoutError } from "../errors.js";
import { jobOptions } from "../job.js";
import { confirmFormats } from "../formats.js";
import type {
    Algorithm,
    ExportFormat,
    ExportView,
    BoundaryEdges,
    PathShape,
    QuadOptions,
    SolveOptions,
    SurfaceMapOptions,
} from "../types.js";

export interface EmbedCommand {
    name: "embed";
    layout: string;
    target: string;
    landmarks: string | null;
    repair: boolean;
    /** A file with what length costs at the target's vertices. */
    vertexCosts: string | null;
    /** A file with how much the lengths of the layout edges' paths count. */
    edgeWeights: string | null;
    /** Folders with earlier outputs that are not to be found again. */
    excluded: string[];
    /** Which layout edges are to keep their routes, or to take others, than in an earlier output. */
    previous: { folder: string; keep: number[]; avoid: number[] } | null;
    output: string | null;
    /** Whether to write a quad mesh, too, and which. */
    quads: QuadOptions | null;
    /** Further formats to write. */
    formats: ExportFormat[];
    view: ExportView;
    /** Whether to write a report on paths and patches. */
    report: boolean;
    /** Whether refined.obj is to have what the target's file says besides places. */
    attributes: boolean;
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

export interface ConvertCommand {
    name: "convert";
    input: string;
    output: string;
    view: ExportView;
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

export interface MapCommand {
    name: "map";
    layout: string;
    targets: [string, string];
    /** Per target; null for landmarks by proximity. */
    landmarks: [string | null, string | null];
    output: string;
    repair: boolean;
    quiet: boolean;
    json: boolean;
    solve: SolveOptions;
    map: SurfaceMapOptions;
}

export interface BatchCommand {
    name: "batch";
    layout: string;
    folder: string;
    output: string;
    /** The member that all others are mapped from; null for the first one that is embedded. */
    reference: string | null;
    repair: boolean;
    quiet: boolean;
    json: boolean;
    solve: SolveOptions;
    quads: QuadOptions;
    map: SurfaceMapOptions;
}

export type Command =
    | { name: "help" }
    | { name: "version" }
    | EmbedCommand
    | CheckCommand
    | LayoutCommand
    | ConvertCommand
    | MapCommand
    | BatchCommand;

const commonOptions = {
    help: { type: "boolean" },
    landmarks: { type: "string" },
    repair: { type: "boolean" },
    json: { type: "boolean" },
} as const satisfies ParseArgsConfig["options"];

/** Those of a search and of the paths' shape. */
const solveOptions = {
    algorithm: { type: "string" },
    gap: { type: "string" },
    "time-limit": { type: "string" },
    "work-limit": { type: "string" },
    "memory-limit": { type: "string" },
    seed: { type: "string" },
    shape: { type: "string" },
    "boundary-edges": { type: "string" },
    features: { type: "string" },
} as const satisfies ParseArgsConfig["options"];

type SolveValues = ReturnType<typeof parseArgs<{ options: typeof solveOptions }>>["values"];

const embedOptions = {
    ...commonOptions,
    ...solveOptions,
    "vertex-costs": { type: "string" },
    "edge-weights": { type: "string" },
    exclude: { type: "string", multiple: true },
    previous: { type: "string" },
    keep: { type: "string", multiple: true },
    avoid: { type: "string", multiple: true },
    output: { type: "string" },
    format: { type: "string", multiple: true },
    view: { type: "string" },
    report: { type: "boolean" },
    attributes: { type: "boolean" },
    quiet: { type: "boolean" },
} as const satisfies ParseArgsConfig["options"];

type EmbedValues = ReturnType<typeof parseArgs<{ options: typeof embedOptions }>>["values"];

const quadOptions = {
    ...embedOptions,
    "edge-length": { type: "string" },
    segments: { type: "string", multiple: true },
    relaxation: { type: "string" },
} as const satisfies ParseArgsConfig["options"];

/** What map and batch have in common. */
const mappingOptions = {
    ...solveOptions,
    help: { type: "boolean" },
    output: { type: "string" },
    rounds: { type: "string" },
    "seam-passes": { type: "string" },
    repair: { type: "boolean" },
    quiet: { type: "boolean" },
    json: { type: "boolean" },
} as const satisfies ParseArgsConfig["options"];

const mapOptions = {
    ...mappingOptions,
    "landmarks-a": { type: "string" },
    "landmarks-b": { type: "string" },
} as const satisfies ParseArgsConfig["options"];

const batchOptions = {
    ...mappingOptions,
    reference: { type: "string" },
    "edge-length": { type: "string" },
} as const satisfies ParseArgsConfig["options"];

const convertOptions = {
    help: { type: "boolean" },
    json: { type: "boolean" },
    view: { type: "string" },
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
        case "quads":
            return parseQuads(rest);
        case "check":
            return parseCheck(rest);
        case "layout":
            return parseLayout(rest);
        case "convert":
            return parseConvert(rest);
        case "map":
            return parseMap(rest);
        case "batch":
            return parseBatch(rest);
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
    return values.help ? { name: "help" } : embedCommand(values, positionals, null);
}

function parseQuads(args: string[]): Command {
    const { values, positionals } = parsed({ args, options: quadOptions, allowPositionals: true });
    if (values.help) {
        return { name: "help" };
    }
    needed("--output DIR", values.output);
    const segments = (values.segments ?? []).flatMap((list) => list.split(",")).map(segmentPair);
    return embedCommand(values, positionals, {
        ...given("edgeLength", number("--edge-length", values["edge-length"])),
        segments,
        ...given("relaxation", number("--relaxation", values.relaxation)),
    });
}

/** `EDGE=N`: a layout edge and its number of segments. */
function segmentPair(text: string): [number, number] {
    const match = /^(\d+)=(\d+)$/.exec(text);
    if (match === null) {
        throw new LayoutError("invalidOption", `--segments has "${text}"; give EDGE=NUMBER.`);
    }
    return [Number(match[1]), Number(match[2])];
}

function embedCommand(
    values: EmbedValues,
    positionals: string[],
    quads: QuadOptions | null,
): EmbedCommand {
    // The reference implementation's input names both files.
    const [first] = positionals;
    const [layout, target] =
        positionals.length === 1 && first !== undefined && /\.inp$/i.test(first)
            ? [first, ""]
            : paths(positionals, ["LAYOUT", "TARGET"]);
    const formats = (values.format ?? []).flatMap((list) => list.split(","));
    confirmFormats(formats);
    if (formats.length > 0 && values.output === undefined) {
        throw javaScriptError("usage", "--format needs --output DIR");
    }
    const solve = solveValues(values);
    return {
        name: "embed",
        layout,
        target,
        landmarks: values.landmarks ?? null,
        repair: values.repair === true,
        vertexCosts: values["vertex-costs"] ?? null,
        edgeWeights: values["edge-weights"] ?? null,
        excluded: values.exclude ?? [],
        previous: previous(values),
        output: values.output ?? null,
        quads,
        formats,
        view: view(values.view),
        report: values.report === true,
        attributes: values.attributes === true,
        quiet: values.quiet === true,
        json: values.json === true,
        solve,
    };
}

/** The options of a search; wrong values are found before any file is read. */
function solveValues(values: SolveValues): SolveOptions {
    const discount = number("--features", values.features);
    const solve: SolveOptions = {
        ...given("algorithm", values.algorithm as Algorithm | undefined),
        ...given("gap", number("--gap", values.gap)),
        ...given("timeLimit", number("--time-limit", values["time-limit"])),
        ...given("workLimit", number("--work-limit", values["work-limit"])),
        ...given("memoryLimit", number("--memory-limit", values["memory-limit"], 1e6)),
        ...given("shape", values.shape as PathShape | undefined),
        ...given("seed", number("--seed", values.seed)),
        ...given("boundaryEdges", values["boundary-edges"] as BoundaryEdges | undefined),
        ...given("metric", discount === undefined ? undefined : { featureDiscount: discount }),
    };
    jobOptions(solve);
    return solve;
}

function mapValues(values: { rounds?: string; "seam-passes"?: string }): SurfaceMapOptions {
    return {
        ...given("rounds", number("--rounds", values.rounds)),
        ...given("seamPasses", number("--seam-passes", values["seam-passes"])),
    };
}

function parseMap(args: string[]): Command {
    const { values, positionals } = parsed({ args, options: mapOptions, allowPositionals: true });
    if (values.help) {
        return { name: "help" };
    }
    const [layout, a, b] = paths(positionals, ["LAYOUT", "TARGET_A", "TARGET_B"]);
    return {
        name: "map",
        layout,
        targets: [a, b],
        landmarks: [values["landmarks-a"] ?? null, values["landmarks-b"] ?? null],
        output: needed("--output DIR", values.output),
        repair: values.repair === true,
        quiet: values.quiet === true,
        json: values.json === true,
        solve: solveValues(values),
        map: mapValues(values),
    };
}

function parseBatch(args: string[]): Command {
    const { values, positionals } = parsed({ args, options: batchOptions, allowPositionals: true });
    if (values.help) {
        return { name: "help" };
    }
    const [layout, folder] = paths(positionals, ["LAYOUT", "FOLDER"]);
    return {
        name: "batch",
        layout,
        folder,
        output: needed("--output DIR", values.output),
        reference: values.reference ?? null,
        repair: values.repair === true,
        quiet: values.quiet === true,
        json: values.json === true,
        solve: solveValues(values),
        quads: given("edgeLength", number("--edge-length", values["edge-length"])),
        map: mapValues(values),
    };
}

function previous({ previous: folder, keep = [], avoid = [] }: EmbedValues) {
    if (folder === undefined) {
        if (keep.length + avoid.length > 0) {
            throw javaScriptError("usage", "--keep and --avoid need --previous DIR");
        }
        return null;
    }
    return { folder, keep: edgeList("--keep", keep), avoid: edgeList("--avoid", avoid) };
}

/** Layout edges, separated by commas. */
function edgeList(option: string, lists: string[]): number[] {
    return lists
        .flatMap((list) => list.split(","))
        .map((text) => {
            if (!/^\d+$/.test(text)) {
                throw new LayoutError("invalidOption", `${option} has "${text}"; give edge ids.`);
            }
            return Number(text);
        });
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

function parseConvert(args: string[]): Command {
    const { values, positionals } = parsed({
        args,
        options: convertOptions,
        allowPositionals: true,
    });
    if (values.help) {
        return { name: "help" };
    }
    const [input, output] = paths(positionals, ["INPUT", "OUTPUT"]);
    return { name: "convert", input, output, view: view(values.view) };
}

/** `X,Y,Z` or `X,Y,Z,UX,UY,UZ`: the direction towards the eye, and what is up. */
function view(text: string | undefined): ExportView {
    if (text === undefined) {
        return {};
    }
    const numbers = text.split(",").map((part) => number("--view", part) ?? 0);
    const [x = 0, y = 0, z = 0, ...up] = numbers;
    if (numbers.length !== 3 && numbers.length !== 6) {
        throw new LayoutError(
            "invalidOption",
            `--view is "${text}"; give three numbers, or six with what is up.`,
        );
    }
    // Looking from above or below, y is no direction in the picture.
    const usual: [number, number, number] = x === 0 && z === 0 ? [0, 0, 1] : [0, 1, 0];
    return {
        direction: [x, y, z],
        up: numbers.length === 6 ? (up as [number, number, number]) : usual,
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
        const option = /'(?:-\w, )?(--?[\w-]+)/.exec(message)?.[1] ?? "an option";
        switch ((reason as { code?: unknown }).code) {
            case "ERR_PARSE_ARGS_UNKNOWN_OPTION":
                throw javaScriptError("usage", `there is no option ${option} here`);
            case "ERR_PARSE_ARGS_INVALID_OPTION_VALUE":
                throw javaScriptError(
                    "usage",
                    message.includes("not take")
                        ? `${option} takes no value`
                        : `${option} needs a value; one that begins with a dash is given as ${option}=VALUE`,
                );
            default:
        }
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
