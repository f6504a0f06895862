// Embeddings in the formats of other programs, and the reference implementation's input files.
import { claimInCore } from "./claim.js";
import { Core, type Handle } from "./core.js";
import { javaScriptError, LayoutError } from "./errors.js";
import { readFile } from "./mesh.js";
import type { EmbeddingClaim, ExportFormat, ExportView, ReferenceInput } from "./types.js";

// In the order of the boundary's ExportFormat (boundary/formats.cc).
const meshFormats = ["obj", "ply", "vtp", "glb", "svg"] as const;

/** All formats that an embedding can be exported in. */
export const exportFormats: readonly ExportFormat[] = [...meshFormats, "lem"];

/** Throws invalidOption for what is no format of an export. */
export function confirmFormats(formats: readonly string[]): asserts formats is ExportFormat[] {
    for (const format of formats) {
        if (!(exportFormats as readonly string[]).includes(format)) {
            throw new LayoutError(
                "invalidOption",
                `there is no export format ${format}; choose from ${exportFormats.join(", ")}.`,
            );
        }
    }
}

/** The files of a job's embedding. */
export function exportJob(
    core: Core,
    job: Handle,
    formats: readonly ExportFormat[],
    view: ExportView,
): Record<string, Uint8Array> {
    confirmFormats(formats);
    const files: Record<string, Uint8Array> = {};
    for (const format of formats) {
        if (format === "lem") {
            Object.assign(files, referenceFiles(core, job));
        } else {
            files[`refined.${format}`] = write(core, "boundary_job_write", job, format, view);
        }
    }
    return files;
}

/** A job's embedding as refined.obj, with the attributes of its target. */
export function refinedObj(core: Core, job: Handle): Uint8Array {
    return write(core, "boundary_job_write", job, "obj", {});
}

/** A claimed embedding, which is not looked at further, in a format. */
export function exportClaim(
    core: Core,
    claim: EmbeddingClaim,
    format: Exclude<ExportFormat, "lem">,
    view: ExportView,
): Uint8Array {
    const check = claimInCore(core, claim);
    try {
        return write(core, "boundary_check_write", check, format, view);
    } finally {
        core.destroy(check);
    }
}

function write(
    core: Core,
    name: string,
    handle: Handle,
    format: (typeof meshFormats)[number],
    { direction = [0, 0, 1], up = [0, 1, 0], width = 800 }: ExportView,
): Uint8Array {
    if (direction.length !== 3 || up.length !== 3) {
        throw new LayoutError(
            "invalidOption",
            "direction and up of a view are 3 numbers each; correct the option.",
        );
    }
    core.withCopies((copy) =>
        core.call(
            name,
            handle,
            meshFormats.indexOf(format),
            copy(Float64Array.from([...direction, ...up, width])),
        ),
    );
    return core.viewedBytes();
}

/** Without the target's attributes. */
function plainObj(core: Core, job: Handle): Uint8Array {
    core.call("boundary_job_write_obj", job);
    return core.viewedBytes();
}

function referenceFiles(core: Core, job: Handle): Record<string, Uint8Array> {
    const named = (name: string, first: string, second: string) => {
        core.withCopies((copy) => {
            const a = utf8(first);
            const b = utf8(second);
            return core.call(name, job, copy(a), a.length, copy(b), b.length);
        });
        return core.viewedBytes();
    };
    const input = (name: string) => {
        core.call(`boundary_job_write_${name}`, job);
        return core.viewedBytes();
    };
    return {
        "refined.inp": named(
            "boundary_job_write_inp",
            "refined_layout.obj",
            "refined_target_input.obj",
        ),
        "refined.lem": named("boundary_job_write_lem", "refined.inp", "refined_target.obj"),
        "refined_layout.obj": input("layout"),
        "refined_target_input.obj": input("target"),
        "refined_target.obj": plainObj(core, job),
    };
}

/** Reads an `.inp` file of the reference implementation. */
export async function readReferenceInput(
    bytes: Uint8Array,
    name?: string,
): Promise<ReferenceInput> {
    const core = await Core.create();
    const subject = utf8(`the reference input${name === undefined ? "" : ` ${name}`}`);
    const handle = core.withCopies((copy) =>
        core.call(
            "boundary_reference_read",
            copy(bytes),
            bytes.length,
            copy(subject),
            subject.length,
        ),
    );
    core.call("boundary_reference_layout", handle);
    const layoutFile = core.viewedText();
    core.call("boundary_reference_target", handle);
    const targetFile = core.viewedText();
    return {
        layoutFile,
        targetFile,
        // The instance of the module lives as long as this function is held.
        landmarks: (vertexCount) => {
            core.withCopies((copy) =>
                core.call(
                    "boundary_reference_landmarks",
                    handle,
                    vertexCount,
                    copy(subject),
                    subject.length,
                ),
            );
            return core.viewedIds();
        },
    };
}

/** A mesh file in another format; the ending of `output` gives it. */
export async function convertMesh(
    input: { bytes: Uint8Array; name: string },
    output: string,
): Promise<Uint8Array> {
    const match = /\.(obj|off|ply)$/i.exec(output);
    if (match?.[1] === undefined) {
        throw javaScriptError(
            "invalidInput",
            `a mesh can be written as .obj, .off or .ply, not as ${output}`,
        );
    }
    const core = await Core.create();
    const mesh = readFile(core, `the mesh ${input.name}`, input);
    core.call(`boundary_mesh_write_${match[1].toLowerCase()}`, mesh);
    return core.viewedBytes();
}

function utf8(text: string): Uint8Array {
    return new TextEncoder().encode(text);
}
