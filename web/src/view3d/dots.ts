import {
    BufferAttribute,
    BufferGeometry,
    CanvasTexture,
    Color,
    LinearFilter,
    Points,
    ShaderMaterial,
} from "three";
import type { ViewTheme } from "./colors.js";

/** Landmarks beyond this many get dots without numbers: the texture would grow too large. */
const maximumNumbers = 1024;
const cell = 64;

const vertexShader = `
attribute float number;
uniform float size;
uniform float scale;
uniform float highlighted;
uniform float bias;
uniform float horizon;
varying float vNumber;
varying float vHighlighted;
void main() {
  vec4 eye = modelViewMatrix * vec4(position, 1.0);
  gl_Position = projectionMatrix * eye;
  // Depth as if the dot floated in front of the surface, so that it is not half sunk into it.
  vec4 lifted = projectionMatrix * (eye + vec4(0.0, 0.0, bias, 0.0));
  gl_Position.z = lifted.z / lifted.w * gl_Position.w;
  vNumber = number;
  vHighlighted = highlighted == number ? 1.0 : 0.0;
  gl_PointSize = size * scale * (vHighlighted > 0.5 ? 1.35 : 1.0);
  // Dots on the far side are left out as a whole rather than cut by the silhouette.
  vec3 facing = normalize(normalMatrix * normal);
  if (dot(facing, normalize(-eye.xyz)) < horizon) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`;

const fragmentShader = `
uniform sampler2D digits;
uniform float columns;
uniform float numbered;
uniform vec3 dot_;
uniform vec3 ink;
uniform vec3 accent;
varying float vNumber;
varying float vHighlighted;
void main() {
  float r = length(gl_PointCoord - 0.5) * 2.0;
  float soft = fwidth(r);
  if (r > 1.0) discard;
  vec3 fill = mix(dot_, accent, vHighlighted);
  float rim = smoothstep(0.82 - soft, 0.82 + soft, r);
  vec3 color = mix(fill, ink, rim);
  if (vNumber < numbered) {
    float row = floor((vNumber + 0.5) / columns);
    vec2 at = vec2(floor(vNumber - row * columns + 0.5), row);
    float text = texture2D(digits, (at + gl_PointCoord) / columns).r;
    color = mix(color, vHighlighted > 0.5 ? dot_ : ink, text * (1.0 - rim));
  }
  gl_FragColor = vec4(color, 1.0 - smoothstep(1.0 - soft, 1.0, r));
  #include <colorspace_fragment>
}`;

/** Numbered dots: landmark or layout vertex i carries the number i. */
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
            highlighted: { value: -1 },
            digits: { value: null },
            columns: { value: 1 },
            numbered: { value: 0 },
            dot_: { value: new Color() },
            ink: { value: new Color() },
            accent: { value: new Color() },
        },
    });
    readonly points = new Points(new BufferGeometry(), this.material);

    /**
     * @param horizon cosine between normal and line of sight below which a dot is on the far side
     */
    constructor(horizon: number) {
        this.material.uniforms["horizon"]!.value = horizon;
        this.points.renderOrder = 4;
        this.points.frustumCulled = false;
        this.points.visible = false;
        this.points.onBeforeRender = (renderer) => {
            this.material.uniforms["scale"]!.value = renderer.getPixelRatio();
        };
    }

    setTheme(theme: ViewTheme): void {
        const { uniforms } = this.material;
        (uniforms["dot_"]!.value as Color).set(theme.dot);
        (uniforms["ink"]!.value as Color).set(theme.dotText);
        (uniforms["accent"]!.value as Color).set(theme.accent);
    }

    /**
     * Places and unit normals with 3 numbers per dot. `radius` is that of the scene; dots float a
     * small share of it in front of the surface.
     */
    setPlaces(
        places: Float32Array<ArrayBuffer>,
        normals: Float32Array<ArrayBuffer>,
        radius: number,
    ): void {
        const { uniforms } = this.material;
        const count = places.length / 3;
        this.points.geometry.dispose();
        this.points.geometry = new BufferGeometry();
        this.points.geometry.setAttribute("position", new BufferAttribute(places, 3));
        this.points.geometry.setAttribute("normal", new BufferAttribute(normals, 3));
        this.points.geometry.setAttribute(
            "number",
            new BufferAttribute(
                Float32Array.from({ length: count }, (_, i) => i),
                1,
            ),
        );
        this.points.visible = count > 0;
        uniforms["bias"]!.value = 0.06 * radius;
        // Many landmarks get smaller dots, down to ones too small for a number.
        const size = count <= 40 ? 22 : count <= 100 ? 17 : 13;
        uniforms["size"]!.value = size;
        this.drawNumbers(count > maximumNumbers ? 0 : count);
    }

    highlight(id: number | null): void {
        this.material.uniforms["highlighted"]!.value = id ?? -1;
    }

    private drawNumbers(count: number): void {
        const { uniforms } = this.material;
        const columns = Math.max(1, Math.ceil(Math.sqrt(count)));
        const canvas = document.createElement("canvas");
        canvas.width = canvas.height = columns * cell;
        const context = canvas.getContext("2d");
        uniforms["numbered"]!.value = context ? count : 0;
        if (!context) return;
        context.fillStyle = "#000";
        context.fillRect(0, 0, canvas.width, canvas.height);
        context.fillStyle = "#fff";
        context.textAlign = "center";
        context.textBaseline = "middle";
        for (let i = 0; i < count; ++i) {
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
    }
}
