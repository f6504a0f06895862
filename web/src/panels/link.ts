import { examples } from "../examples/index.js";
import { loadShapes } from "../gallery/catalogue.js";
import type { Actions } from "../model/actions.js";
import { initialState, type AppState } from "../model/state.js";

/** The address that opens the example or shape that is shown, with its settings. */
export function linkTo({ origin, options }: AppState): string | null {
    if (!origin) return null;
    const settings = new URLSearchParams({ [origin.kind]: origin.name });
    if (options.seed !== initialState.options.seed) settings.set("seed", String(options.seed));
    if (options.gap !== initialState.options.gap) settings.set("gap", String(options.gap));
    const address = new URL(location.href);
    // "class/member" reads better as it is.
    address.hash = settings.toString().replaceAll("%2F", "/");
    return address.href;
}

/** Opens what the page's address asks for; false if it asks for nothing there is. */
export async function openLink(actions: Actions): Promise<boolean> {
    const settings = new URLSearchParams(location.hash.slice(1));
    const number = (name: string) => {
        const value = Number(settings.get(name) ?? NaN);
        return Number.isFinite(value) && value >= 0 ? value : null;
    };
    const [seed, gap] = [number("seed"), number("gap")];
    actions.setOptions({
        ...(seed !== null && Number.isSafeInteger(seed) && { seed }),
        ...(gap !== null && gap <= 1 && { gap }),
    });
    const example = examples.find(({ name }) => name === settings.get("example"));
    if (example) {
        await actions.openExample(example);
        return true;
    }
    const wanted = settings.get("shape");
    if (!wanted) return false;
    const shapes = await loadShapes().catch((error: unknown) => actions.report(error));
    const shape = shapes?.find(({ id }) => id === wanted);
    if (!shape) return false;
    await actions.openShape(shape);
    return true;
}
