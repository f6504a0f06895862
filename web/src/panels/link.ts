import { examples } from "../examples/index.js";
import { loadShapes } from "../gallery/catalogue.js";
import type { Actions } from "../model/actions.js";
import {
    boundaryEdgesNames,
    initialState,
    largestDiscount,
    type AppState,
    type SolveSettings,
} from "../model/state.js";

/** A setting as it stands in a link. */
interface LinkSetting {
    readonly name: string;
    /** Null where it is as at first. */
    readonly write: (settings: SolveSettings) => string | null;
    /** Null where the text makes no sense. */
    readonly read: (text: string) => Partial<SolveSettings> | null;
    /** What it has to be. */
    readonly wanted: string;
}

const usual = initialState.options;
const changed = (value: number, first: number) => (value === first ? null : String(value));
/** A number from 0 to `most`. */
const amount = (text: string, most: number): number | null => {
    const value = text.trim() === "" ? NaN : Number(text);
    return value >= 0 && value <= most ? value : null;
};

const linkSettings: readonly LinkSetting[] = [
    {
        name: "seed",
        write: ({ seed }) => changed(seed, usual.seed),
        read: (text) => {
            const seed = amount(text, Number.MAX_SAFE_INTEGER);
            return seed !== null && Number.isInteger(seed) ? { seed } : null;
        },
        wanted: "a whole number that is not negative",
    },
    {
        name: "gap",
        write: ({ gap }) => changed(gap, usual.gap),
        read: (text) => {
            const gap = amount(text, 1);
            return gap === null ? null : { gap };
        },
        wanted: "a number from 0 to 1",
    },
    {
        name: "features",
        write: ({ featureDiscount }) => changed(featureDiscount, usual.featureDiscount),
        read: (text) => {
            const featureDiscount = amount(text, largestDiscount);
            return featureDiscount === null ? null : { featureDiscount };
        },
        wanted: `a number from 0 to ${largestDiscount}`,
    },
    {
        name: "boundary",
        write: ({ boundaryEdges }) =>
            boundaryEdges === usual.boundaryEdges ? null : boundaryEdges,
        read: (text) => {
            const boundaryEdges = boundaryEdgesNames.find((name) => name === text);
            return boundaryEdges === undefined ? null : { boundaryEdges };
        },
        wanted: boundaryEdgesNames.join(" or "),
    },
];

/** The address that opens the example or shape that is shown, with its settings. */
export function linkTo({ origin, options }: AppState): string | null {
    if (!origin) return null;
    const settings = new URLSearchParams({ [origin.kind]: origin.name });
    for (const { name, write } of linkSettings) {
        const text = write(options);
        if (text !== null) settings.set(name, text);
    }
    const address = new URL(location.href);
    // "class/member" reads better as it is.
    address.hash = settings.toString().replaceAll("%2F", "/");
    return address.href;
}

/** Opens what the page's address asks for; false if it asks for nothing there is. */
export async function openLink(actions: Actions): Promise<boolean> {
    const given = new URLSearchParams(location.hash.slice(1));
    const refused: string[] = [];
    for (const { name, read, wanted } of linkSettings) {
        const text = given.get(name);
        const setting = text === null ? {} : read(text);
        if (setting) actions.setOptions(setting);
        else refused.push(`${name}=${text} in the link was left out: it has to be ${wanted}.`);
    }
    const opened = await openOrigin(given, actions);
    // What is opened has cleared earlier notices away.
    for (const words of refused) actions.notice(words);
    return opened;
}

async function openOrigin(given: URLSearchParams, actions: Actions): Promise<boolean> {
    const example = examples.find(({ name }) => name === given.get("example"));
    if (example) {
        await actions.openExample(example);
        return true;
    }
    const wanted = given.get("shape");
    if (!wanted) return false;
    const shapes = await loadShapes().catch((error: unknown) => actions.report(error));
    const shape = shapes?.find(({ id }) => id === wanted);
    if (!shape) return false;
    await actions.openShape(shape);
    return true;
}
