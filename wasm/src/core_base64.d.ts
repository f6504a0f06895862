/** core.wasm, compressed with gzip, in base64; build.mjs writes this module. */
export declare const gzippedCore: string;
