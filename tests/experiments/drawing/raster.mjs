// Shaded triangles, lines and dots through a depth buffer, seen without perspective.
import { cross, dot, normalized } from "../../bench/vectors.mjs";

const samples = 2; // per pixel, across and down
const light = normalized([-0.35, 0.45, 1]);

/** A camera that looks at the surface from `direction`, with the points' box in the picture. */
export function cameraFor(positions, { direction = [0, 0, 1], up = [0, 1, 0], width, height }) {
    const z = normalized(direction);
    const x = normalized(cross(up, z));
    const y = cross(z, x);
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < positions.length; i += 3) {
        const p = [positions[i], positions[i + 1], positions[i + 2]];
        [x, y, z].forEach((axis, k) => {
            const along = dot(p, axis);
            low[k] = Math.min(low[k], along);
            high[k] = Math.max(high[k], along);
        });
    }
    const margin = 0.96;
    const scale =
        margin * Math.min(width / (high[0] - low[0] || 1), height / (high[1] - low[1] || 1));
    const middle = [0, 1].map((k) => (low[k] + high[k]) / 2);
    return {
        x,
        y,
        z,
        size: high[2] - low[2],
        width,
        height,
        project: (px, py, pz) => [
            width / 2 + scale * (x[0] * px + x[1] * py + x[2] * pz - middle[0]),
            height / 2 - scale * (y[0] * px + y[1] * py + y[2] * pz - middle[1]),
            z[0] * px + z[1] * py + z[2] * pz,
        ],
    };
}

export class Raster {
    constructor(camera) {
        this.camera = camera;
        this.width = samples * camera.width;
        this.height = samples * camera.height;
        this.depth = new Float32Array(this.width * this.height).fill(-Infinity);
        this.colour = new Uint8Array(3 * this.width * this.height).fill(255);
    }

    project(positions, vertex) {
        const [x, y, z] = this.camera.project(
            positions[3 * vertex],
            positions[3 * vertex + 1],
            positions[3 * vertex + 2],
        );
        return [samples * x, samples * y, z];
    }

    /**
     * `colourOf(triangle, weights)`: red, green, blue from 0 to 255 at a point of a triangle with
     * these barycentric coordinates. What shows its back is greyed.
     */
    triangles(positions, corners, colourOf) {
        const normals = vertexNormals(positions, corners);
        const { x: right, y: top, z: eye } = this.camera;
        const turned = (n) => [dot(n, right), dot(n, top), dot(n, eye)];
        const lit = new Float32Array(normals.length / 3);
        for (let v = 0; v < lit.length; ++v) {
            const n = turned(normals.subarray(3 * v, 3 * v + 3));
            lit[v] = 0.5 + 0.5 * Math.max(-0.3, dot(n, light));
        }
        for (let t = 0; 3 * t < corners.length; ++t) {
            const ids = [corners[3 * t], corners[3 * t + 1], corners[3 * t + 2]];
            const [a, b, c] = ids.map((v) => this.project(positions, v));
            const area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            if (area === 0) {
                continue;
            }
            const isBack = area > 0;
            const x0 = Math.max(0, Math.ceil(Math.min(a[0], b[0], c[0])));
            const x1 = Math.min(this.width - 1, Math.floor(Math.max(a[0], b[0], c[0])));
            const y0 = Math.max(0, Math.ceil(Math.min(a[1], b[1], c[1])));
            const y1 = Math.min(this.height - 1, Math.floor(Math.max(a[1], b[1], c[1])));
            for (let y = y0; y <= y1; ++y) {
                for (let x = x0; x <= x1; ++x) {
                    const u = ((b[0] - x) * (c[1] - y) - (b[1] - y) * (c[0] - x)) / area;
                    const v = ((c[0] - x) * (a[1] - y) - (c[1] - y) * (a[0] - x)) / area;
                    const w = 1 - u - v;
                    if (u < 0 || v < 0 || w < 0) {
                        continue;
                    }
                    const z = u * a[2] + v * b[2] + w * c[2];
                    const at = y * this.width + x;
                    if (z <= this.depth[at]) {
                        continue;
                    }
                    this.depth[at] = z;
                    const shade = isBack
                        ? 0.55
                        : u * lit[ids[0]] + v * lit[ids[1]] + w * lit[ids[2]];
                    const rgb = isBack ? [190, 182, 178] : colourOf(t, [u, v, w]);
                    for (let k = 0; k < 3; ++k) {
                        this.colour[3 * at + k] = Math.min(255, 1.08 * shade * rgb[k]);
                    }
                }
            }
        }
    }

    /** A polyline on the surface (3 coordinates per point), `width` pixels wide. Returns the number of
     * samples that are seen. */
    line(points, rgb, width) {
        let seen = 0;
        let previous = null;
        for (let i = 0; 3 * i < points.length; ++i) {
            const point = this.project(points, i);
            if (previous !== null) {
                const length = Math.hypot(point[0] - previous[0], point[1] - previous[1]);
                const steps = Math.max(1, Math.ceil(length));
                for (let s = 0; s <= steps; ++s) {
                    const p = previous.map((value, k) => value + (s / steps) * (point[k] - value));
                    seen += this.dotAt(p, rgb, width);
                }
            }
            previous = point;
        }
        return seen;
    }

    dot(position, rgb, width) {
        this.dotAt(this.project(position, 0), rgb, width);
    }

    dotAt([cx, cy, cz], rgb, width) {
        // What lies on the surface is drawn a little in front of it.
        const z = cz + 0.012 * this.camera.size;
        const radius = (samples * width) / 2;
        let seen = 0;
        for (let y = Math.ceil(cy - radius); y <= cy + radius; ++y) {
            for (let x = Math.ceil(cx - radius); x <= cx + radius; ++x) {
                const inside =
                    x >= 0 &&
                    y >= 0 &&
                    x < this.width &&
                    y < this.height &&
                    (x - cx) ** 2 + (y - cy) ** 2 <= radius ** 2;
                const at = y * this.width + x;
                if (inside && z > this.depth[at]) {
                    this.colour.set(rgb, 3 * at);
                    ++seen;
                }
            }
        }
        return seen;
    }

    /** 3 bytes per pixel. */
    pixels() {
        const { width, height } = this.camera;
        const pixels = new Uint8Array(3 * width * height);
        for (let y = 0; y < height; ++y) {
            for (let x = 0; x < width; ++x) {
                for (let k = 0; k < 3; ++k) {
                    let sum = 0;
                    for (let dy = 0; dy < samples; ++dy) {
                        for (let dx = 0; dx < samples; ++dx) {
                            const at = (samples * y + dy) * this.width + samples * x + dx;
                            sum += this.colour[3 * at + k];
                        }
                    }
                    pixels[3 * (y * width + x) + k] = sum / samples ** 2;
                }
            }
        }
        return pixels;
    }
}

function vertexNormals(positions, corners) {
    const normals = new Float64Array(positions.length);
    for (let t = 0; t < corners.length; t += 3) {
        const [a, b, c] = [0, 1, 2].map((k) =>
            positions.slice(3 * corners[t + k], 3 * corners[t + k] + 3),
        );
        const normal = cross(
            [b[0] - a[0], b[1] - a[1], b[2] - a[2]],
            [c[0] - a[0], c[1] - a[1], c[2] - a[2]],
        );
        for (let k = 0; k < 3; ++k) {
            for (let axis = 0; axis < 3; ++axis) {
                normals[3 * corners[t + k] + axis] += normal[axis];
            }
        }
    }
    for (let v = 0; v < normals.length; v += 3) {
        const length = Math.hypot(normals[v], normals[v + 1], normals[v + 2]) || 1;
        for (let axis = 0; axis < 3; ++axis) {
            normals[v + axis] /= length;
        }
    }
    return normals;
}
