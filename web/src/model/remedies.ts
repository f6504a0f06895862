// What may help against a problem, as a button beside it.
import { mends } from "./mending.js";
import { edgeOf } from "./places.js";
import { nameOf, type Role, type Source } from "./sources.js";
import type { PathSettings, Problem } from "./state.js";
import type { UncheckedMesh } from "layout-embedding";

/** Errors that reading again with repair may get rid of. */
const repairable = new Set([
    "degenerateFace",
    "duplicateFace",
    "coincidentVertices",
    "unusedVertex",
]);

/** What remedies do, all of it actions. */
export interface RemedyActions {
    setRepair(repair: boolean): void;
    openAs(role: Role, source: Source): Promise<void>;
    setMaking(making: boolean): Promise<void>;
    setPathSettings(change: Partial<PathSettings>): void;
    solve(): Promise<void>;
    notice(text: string): void;
    /** A mesh that was refused, or null, with a problem reported. */
    mended<Result>(
        role: Role,
        source: Source,
        mend: (mesh: UncheckedMesh) => Result,
    ): Promise<Result | null>;
}

const codeOf = (error: unknown): string =>
    error instanceof Error && "code" in error ? String(error.code) : "";

/** For a mesh that was refused; `repairs`: whether it was repaired already. */
export function meshRemedy(
    error: unknown,
    role: Role,
    source: Source,
    repairs: boolean,
    actions: RemedyActions,
): Problem["remedy"] {
    const code = codeOf(error);
    if (!repairs && repairable.has(code))
        return {
            label: "Repair and read again",
            apply: () => {
                actions.setRepair(true);
                void actions.openAs(role, source);
            },
        };
    // What changes the mesh more than a repair does, and so has to be asked for.
    const help = mends[code];
    if (!help) return null;
    const apply = async () => {
        const mended = await actions.mended(role, source, help.mend);
        if (!mended) return;
        await actions.openAs(role, { ...mended.mesh, name: nameOf(source) });
        actions.notice(mended.note);
    };
    return { label: help.label, apply: () => void apply() };
}

/** For a target that the layout does not fit: a layout of its own. */
export const layoutRemedy = (error: unknown, actions: RemedyActions): Problem["remedy"] =>
    codeOf(error) === "topologyMismatch"
        ? { label: "Make a layout for it", apply: () => void actions.setMaking(true) }
        : null;

/** For boundary edges that cannot follow the target's boundary. */
export const boundaryRemedy = (error: unknown, actions: RemedyActions): Problem["remedy"] =>
    codeOf(error) === "invalidOption" && edgeOf(error) !== null
        ? {
              label: "Let boundary edges run freely",
              apply: () => {
                  actions.setPathSettings({ boundaryEdges: "free" });
                  void actions.solve();
              },
          }
        : null;
