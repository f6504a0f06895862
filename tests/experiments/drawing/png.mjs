// PNG files of RGB pixels.
import { crc32, deflateSync } from "node:zlib";

function chunk(type, data) {
    const bytes = Buffer.alloc(12 + data.length);
    bytes.writeUInt32BE(data.length, 0);
    bytes.write(type, 4, "latin1");
    data.copy(bytes, 8);
    bytes.writeUInt32BE(crc32(bytes.subarray(4, 8 + data.length)), 8 + data.length);
    return bytes;
}

/** `pixels`: 3 bytes per pixel, row by row from the top. */
export function pngOf(width, height, pixels) {
    const header = Buffer.alloc(13);
    header.writeUInt32BE(width, 0);
    header.writeUInt32BE(height, 4);
    header.set([8, 2, 0, 0, 0], 8); // 8 bits, RGB
    const stride = 3 * width;
    const rows = Buffer.alloc(height * (1 + stride));
    for (let y = 0; y < height; ++y) {
        const row = y * (1 + stride);
        rows[row] = 1; // each byte less the one of the pixel to its left
        for (let x = 0; x < stride; ++x) {
            rows[row + 1 + x] = pixels[y * stride + x] - (x < 3 ? 0 : pixels[y * stride + x - 3]);
        }
    }
    return Buffer.concat([
        Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]),
        chunk("IHDR", header),
        chunk("IDAT", deflateSync(rows, { level: 9 })),
        chunk("IEND", Buffer.alloc(0)),
    ]);
}
