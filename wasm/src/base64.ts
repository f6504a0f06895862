// core.wasm as text in a module ("layout-embedding/base64"), for where scripts can be loaded and
// nothing else: a bundle of one file, a sandbox without fetch().
import { gzippedCore } from "./core_base64.js";

/**
 * The bytes of core.wasm, for `init({ wasm })` and `createWorkerClient({ wasm })`. Every call makes
 * new ones.
 */
export async function coreBytes(): Promise<Uint8Array<ArrayBuffer>> {
    const gzipped = Uint8Array.from(atob(gzippedCore), (character) => character.charCodeAt(0));
    const bytes = new Blob([gzipped]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Uint8Array(await new Response(bytes).arrayBuffer());
}
