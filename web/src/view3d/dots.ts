import {
    BufferAttribute,
    BufferGeometry,
    CanvasTexture,
    Color,
    LinearFilter,
    Points,
    ShaderMaterial,
    Vector2,
    Vector4,
    type Plane,
    type WebGLRenderer,
} from "three";
import { dotColor, type ViewTheme } from "./colors.js";

/** Landmarks beyond this many get dots without numbers: the texture would grow too large. */
const maximumNumbers = 1024;
const cell = 64;
/** CSS pixels across, from which on dots have their full size. */
const roomyView = 380;

const vertexShader = `
attribute float number;
attribute vec3 fill;
attribute vec3 ink;
attribute float hollow;
uniform float size;
uniform float scale;
uniform float highlighted;
uniform float bias;
uniform float horizon;
uniform vec4 cut;
varying float vNumber;
varying float vHighlighted;
varying float vHollow;
varying vec3 vFill;
varying vec3 vInk;
void main() {
  vec4 eye = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * eye;
  // Depth as if the dot floated in front of the surface, so that it is not half sunk into it.
  vec4 lifted = projectionMatrix * (eye + vec4(0.0, 0.0, bias, 0.0));
  gl_Position.z = lifted.z / lifted.w * gl_Position.w;
  vNumber = number;
  vFill = fill;
  vInk = ink;
  vHollow = hollow;
  vHighlighted = highlighted == number ? 1.0 : 0.0;
  gl_PointSize = size * scale * (vHighlighted > 0.5 ? 1.4 : 1.0);
  // Dots on the far side are left out as a whole rather than cut by the silhouette.
  vec3 facing = normalize(normalMatrix * normal);
  bool hidden = dot(facing, normalize(-eye.xyz)) < horizon || dot(cut, vec4(position, 1.0)) < 0.0;
  if (hidden) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;

const fragmentShader = `
uniform sampler2D digits;
uniform float columns;
uniform float numbered;
uniform float opacity;
uniform vec3 paper;
uniform vec3 print;
uniform vec3 accent;
varying float vNumber;
varying float vHighlighted;
varying float vHollow;
varying vec3 vFill;
varying vec3 vInk;
void main() {
  float r = length(gl_PointCoord - 0.5) * 2.0;
  float soft = fwidth(r);
  if (r > 1.0) discard;
  vec3 fill = mix(vFill, paper, vHollow);
  vec3 ink = mix(vInk, print, vHollow);
  // A light ring keeps the dot apart from patches and paths; missing ones are rings themselves.
  vec3 ring = mix(mix(paper, vFill, vHollow), accent, vHighlighted);
  float rim = smoothstep(0.8 - soft, 0.8 + soft, r);
  vec3 color = mix(fill, ring, rim);
  if (vNumber < numbered) {
    float row = floor((vNumber + 0.5) / columns);
    vec2 at = vec2(floor(vNumber - row * columns + 0.5), row);
    float text = texture2D(digits, (at + gl_PointCoord) / columns).r;
    color = mix(color, ink, text * (1.0 - rim));
  }
  gl_FragColor = vec4(color, opacity * (1.0 - smoothstep(1.0 - soft, 1.0, r)));
  #include <colorspace_fragment>
}`;

/** A landmark or layout vertex in a view. */
export interface Dot {
    readonly id: number;
    /** 3 numbers each. */
    readonly place: ArrayLike<number>;
    readonly normal: ArrayLike<number>;
    /** Drawn as a ring: a layout vertex whose landmark is missing. */
    readonly hollow: boolean;
}

/** Numbered dots: landmark or layout vertex i carries the number i and its colour. */
export class Dots {
    private readonly material = new ShaderMaterial({
        vertexShader,
        fragmentShader,
        transparent: true,
        depthWrite: false,
        uniforms: {
            size: { value: 22 },
            scale: { value: 1 },
            bias: { value: 0 },
            horizon: { value: 0 },
            cut: { value: new Vector4(0, 0, 0, 1) },
            highlighted: { value: -1 },
            opacity: { value: 1 },
            digits: { value: null },
            columns: { value: 1 },
            numbered: { value: 0 },
            paper: { value: new Color() },
            print: { value: new Color() },
            accent: { value: new Color() },
        },
    });
    readonly points = new Points(new BufferGeometry(), this.material);
    private drawnNumbers = 0;
    private isShown = true;

    /**
     * @param horizon cosine between normal and line of sight below which a dot is on the far side
     */
    constructor(horizon: number, opacity = 1) {
        this.material.uniforms["horizon"]!.value = horizon;
        this.material.uniforms["opacity"]!.value = opacity;
        this.points.renderOrder = 4;
        this.points.frustumCulled = false;
        this.points.visible = false;
        const view = new Vector2();
        this.points.onBeforeRender = (renderer: WebGLRenderer) => {
            renderer.getSize(view);
            // In a small view, dots of full size would hide the shape.
            const share = Math.min(1, Math.max(0.6, Math.min(view.x, view.y) / roomyView));
            this.material.uniforms["scale"]!.value = renderer.getPixelRatio() * share;
        };
    }

    setTheme(theme: ViewTheme): void {
        const { uniforms } = this.material;
        (uniforms["paper"]!.value as Color).set(theme.dot);
        (uniforms["print"]!.value as Color).set(theme.dotText);
        (uniforms["accent"]!.value as Color).set(theme.accent);
    }

    /**
     * `radius` is that of the scene; dots float a small share of it in front of the surface.
     * `total` is the number of landmarks there will be, which decides how large dots are.
     */
    setDots(dots: readonly Dot[], radius: number, total: number): void {
        const { uniforms } = this.material;
        const geometry = new BufferGeometry();
        const numbers = (size: number, of: (dot: Dot) => ArrayLike<number>) => {
            const values = new Float32Array(size * dots.length);
            dots.forEach((dot, i) => values.set(of(dot), size * i));
            return new BufferAttribute(values, size);
        };
        const rgb = (hex: string) => new Color(hex).toArray();
        geometry.setAttribute(
            "position",
            numbers(3, (dot) => dot.place),
        );
        geometry.setAttribute(
            "normal",
            numbers(3, (dot) => dot.normal),
        );
        geometry.setAttribute(
            "number",
            numbers(1, (dot) => [dot.id]),
        );
        geometry.setAttribute(
            "fill",
            numbers(3, (dot) => rgb(dotColor(dot.id).fill)),
        );
        geometry.setAttribute(
            "ink",
            numbers(3, (dot) => rgb(dotColor(dot.id).text)),
        );
        geometry.setAttribute(
            "hollow",
            numbers(1, (dot) => [dot.hollow ? 1 : 0]),
        );
        this.points.geometry.dispose();
        this.points.geometry = geometry;
        this.points.visible = this.isShown && dots.length > 0;
        uniforms["bias"]!.value = 0.06 * radius;
        // Many landmarks get smaller dots, down to ones too small for a number.
        uniforms["size"]!.value = total <= 40 ? 22 : total <= 100 ? 18 : 13;
        this.drawNumbers(Math.max(0, ...dots.map((dot) => dot.id + 1)));
    }

    get shown(): boolean {
        return this.isShown;
    }

    set shown(on: boolean) {
        this.isShown = on;
        this.points.visible = on && this.points.geometry.hasAttribute("position");
    }

    /** Leaves out what lies on the negative side of a plane; null for nothing. */
    setCut(plane: Plane | null): void {
        const { x, y, z } = plane?.normal ?? { x: 0, y: 0, z: 0 };
        (this.material.uniforms["cut"]!.value as Vector4).set(x, y, z, plane?.constant ?? 1);
    }

    highlight(id: number | null): void {
        this.material.uniforms["highlighted"]!.value = id ?? -1;
    }

    /** Makes sure that the numbers below `count` can be drawn. */
    private drawNumbers(count: number): void {
        const { uniforms } = this.material;
        if (count > maximumNumbers) {
            uniforms["numbered"]!.value = 0;
            return;
        }
        if (count <= this.drawnNumbers) {
            uniforms["numbered"]!.value = this.drawnNumbers;
            return;
        }
        const wanted = Math.min(maximumNumbers, Math.max(32, 2 * count));
        const columns = Math.ceil(Math.sqrt(wanted));
        const canvas = document.createElement("canvas");
        canvas.width = canvas.height = columns * cell;
        const context = canvas.getContext("2d");
        if (!context) return;
        context.fillStyle = "#000";
        context.fillRect(0, 0, canvas.width, canvas.height);
        context.fillStyle = "#fff";
        context.textAlign = "center";
        context.textBaseline = "middle";
        for (let i = 0; i < wanted; ++i) {
            const text = String(i);
            const size = [0, 0.62, 0.54, 0.42, 0.32][text.length] ?? 0.28;
            context.font = `600 ${size * cell}px system-ui, sans-serif`;
            context.fillText(
                text,
                ((i % columns) + 0.5) * cell,
                (Math.floor(i / columns) + 0.53) * cell,
            );
        }
        (uniforms["digits"]!.value as CanvasTexture | null)?.dispose();
        const texture = new CanvasTexture(canvas);
        texture.flipY = false;
        texture.minFilter = LinearFilter;
        texture.generateMipmaps = false;
        uniforms["digits"]!.value = texture;
        uniforms["columns"]!.value = columns;
        uniforms["numbered"]!.value = wanted;
        this.drawnNumbers = wanted;
    }
}
