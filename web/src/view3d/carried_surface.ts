// What a map carries from one target to another, drawn on either of them: a texture in space around
// the first target, the patches, or the distortion.
import {
    BufferAttribute,
    BufferGeometry,
    Color,
    MeshLambertMaterial,
    Sphere,
    Vector3,
} from "three";
import type { LayoutInfo, SurfaceMap, TargetInfo } from "layout-embedding";
import type { Side } from "../model/correspondence.js";
import type { Texture } from "../model/maps.js";
import { patchColors } from "./colors.js";
import { triangleEnergies } from "./distortion.js";

/** From no distortion to an energy of 16 times as much and more: told apart by everyone. */
const scale = ["#f4f1e4", "#f6c667", "#e8743b", "#a51e4d", "#3a0f4f"].map((hex) => new Color(hex));
const largestOctave = 4;

/** What is drawn. */
export interface Carried {
    readonly texture: Texture;
    /** Three times three numbers per triangle of the overlay; white where the material has the colour. */
    readonly colors: Float32Array;
    /** Of the first target, as in TargetInfo; null where it has none. */
    readonly coordinates: Float64Array | null;
}

/**
 * The overlay on one side. Corners are not shared: triangles have colours of their own, and the
 * shading of the target they lie in, whose normals are given per vertex.
 */
export function carriedSurface(
    map: SurfaceMap,
    side: Side,
    target: TargetInfo,
    normals: Float32Array,
    { colors, texture, coordinates }: Carried,
): BufferGeometry {
    const { overlay } = map;
    const { corners } = overlay;
    const places = side === "a" ? overlay.referencePositions : overlay.targetPositions;
    const faces = side === "a" ? overlay.referenceFaces : overlay.targetFaces;
    const weights = side === "a" ? overlay.referenceWeights : overlay.targetWeights;
    const { center, radius } = ball(overlay.referencePositions);
    const position = new Float32Array(3 * corners.length);
    const normal = new Float32Array(3 * corners.length);
    const origin = new Float32Array(3 * corners.length);
    for (let i = 0; i < corners.length; ++i) {
        const from = 3 * corners[i]!;
        const face = faces[Math.floor(i / 3)]!;
        for (let c = 0; c < 3; ++c) {
            position[3 * i + c] = places[from + c]!;
            origin[3 * i + c] =
                (overlay.referencePositions[from + c]! - center.getComponent(c)) / radius;
            for (let k = 0; k < 3; ++k)
                normal[3 * i + c]! +=
                    weights[3 * i + k]! * normals[3 * target.corners[3 * face + k]! + c]!;
        }
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(position, 3));
    geometry.setAttribute("normal", new BufferAttribute(normal, 3));
    const flat = texture === "file" && coordinates ? flatOrigin(map, coordinates) : null;
    geometry.setAttribute("origin", new BufferAttribute(flat ?? origin, 3));
    geometry.setAttribute("color", new BufferAttribute(colors, 3));
    return geometry;
}

/** Texture coordinates of the first target at all corners of the overlay; the third number is 0. */
function flatOrigin({ overlay }: SurfaceMap, coordinates: Float64Array): Float32Array<ArrayBuffer> {
    const { corners, referenceFaces, referenceWeights } = overlay;
    const flat = new Float32Array(3 * corners.length);
    for (let i = 0; i < corners.length; ++i) {
        const face = referenceFaces[Math.floor(i / 3)]!;
        for (let k = 0; k < 3; ++k)
            for (let axis = 0; axis < 2; ++axis)
                flat[3 * i + axis]! +=
                    referenceWeights[3 * i + k]! * coordinates[6 * face + 2 * k + axis]!;
    }
    return flat;
}

/** As in Carried. */
export function carriedColors(map: SurfaceMap, layout: LayoutInfo, texture: Texture): Float32Array {
    const { patches } = map.overlay;
    const colors = new Float32Array(9 * patches.length).fill(1);
    if (texture !== "patches" && texture !== "distortion") return colors;
    const fills = texture === "patches" ? patchColors(layout) : null;
    const energies = fills ? null : triangleEnergies(map);
    const color = new Color();
    patches.forEach((patch, t) => {
        if (fills) color.setHex(fills[patch]!);
        else shade(energies![t]!, color);
        for (let k = 0; k < 3; ++k) color.toArray(colors, 9 * t + 3 * k);
    });
    return colors;
}

function shade(energy: number, into: Color): void {
    const octaves = Math.min(largestOctave, Math.max(0, Math.log2(energy / 4)));
    const step = Math.min(scale.length - 2, Math.floor(octaves));
    into.lerpColors(scale[step]!, scale[step + 1]!, octaves - step);
}

/** As the fragment shader counts them. */
const patterns: Record<Texture, number> = {
    patches: 0,
    distortion: 0,
    grid: 1,
    checker: 2,
    file: 3,
};

/**
 * A material that draws a pattern by where points come from: in the space around the first target, or
 * in its texture coordinates.
 */
export function carriedMaterial(): { material: MeshLambertMaterial; setTexture(t: Texture): void } {
    const pattern = { value: 0 };
    const material = new MeshLambertMaterial({
        vertexColors: true,
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
    });
    material.onBeforeCompile = (shader) => {
        shader.uniforms["pattern"] = pattern;
        shader.vertexShader = shader.vertexShader
            .replace(
                "#include <common>",
                "#include <common>\nattribute vec3 origin;\nvarying vec3 vOrigin;",
            )
            .replace("#include <begin_vertex>", "#include <begin_vertex>\nvOrigin = origin;");
        shader.fragmentShader = shader.fragmentShader
            .replace("#include <common>", `#include <common>${patternFunctions}`)
            .replace(
                "#include <color_fragment>",
                `#include <color_fragment>
                if (pattern > 0.5) diffuseColor.rgb = patternAt(vOrigin);`,
            );
    };
    material.customProgramCacheKey = () => "carried";
    return {
        material,
        setTexture: (texture) => {
            pattern.value = patterns[texture];
        },
    };
}

/** Cells are turned, so that few surfaces run along their walls. */
const patternFunctions = `
uniform float pattern;
varying vec3 vOrigin;
vec3 patternAt(vec3 origin) {
  if (pattern > 2.5) {
    // Squares, 16 to the unit, with the place in the texture as their colour.
    vec2 square = 16.0 * origin.xy;
    vec2 soft = max(fwidth(square), vec2(1e-4));
    vec2 wave = abs(fract(0.5 * square) - 0.5) - 0.25;
    vec2 flip = clamp(wave * 2.0 / soft, -1.0, 1.0);
    vec3 shade = vec3(0.25 + 0.6 * fract(origin.xy), 0.45);
    return shade * (0.75 + 0.25 * flip.x * flip.y);
  }
  mat3 turn = mat3(0.82, 0.41, -0.40, -0.53, 0.80, -0.27, 0.21, 0.43, 0.88);
  vec3 cell = 5.0 * (turn * origin);
  vec3 width = max(fwidth(cell), vec3(1e-4));
  if (pattern > 1.5) {
    // Each wall of a cell swaps dark and light, softened over a pixel.
    vec3 saw = abs(fract(0.5 * cell) - 0.5) - 0.25;
    vec3 swap = clamp(saw * 2.0 / width, -1.0, 1.0);
    return mix(vec3(0.10, 0.16, 0.28), vec3(0.86, 0.88, 0.90), 0.5 + 0.5 * swap.x * swap.y * swap.z);
  }
  vec3 color = mix(vec3(0.03), vec3(0.9), smoothstep(-0.9, 0.9, origin));
  vec3 wall = abs(fract(cell) - 0.5);
  vec3 line = 1.0 - smoothstep(vec3(0.6), vec3(1.5), (0.5 - wall) / width);
  return mix(color, vec3(0.02), 0.85 * max(line.x, max(line.y, line.z)));
}`;

function ball(positions: Float64Array): Sphere {
    const sphere = new Sphere(new Vector3(), 0);
    const point = new Vector3();
    const count = positions.length / 3;
    for (let i = 0; i < count; ++i) sphere.center.add(point.fromArray(positions, 3 * i));
    sphere.center.divideScalar(count);
    for (let i = 0; i < count; ++i)
        sphere.radius = Math.max(
            sphere.radius,
            point.fromArray(positions, 3 * i).distanceTo(sphere.center),
        );
    return sphere;
}
