import { Group } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import type { Polylines } from "layout-embedding";
import type { ViewTheme } from "./colors.js";

/** Widths in CSS pixels. */
const inkWidth = 2.6;
const haloWidth = 5.4;
const highlightWidth = 7;

/** Thick paths over a surface: ink on a halo, with at most one path highlighted. */
export class PathLines {
    readonly group = new Group();
    private readonly ink = lineMaterial(inkWidth, 2);
    private readonly halo = lineMaterial(haloWidth, 1);
    private readonly accent = lineMaterial(highlightWidth, 3);
    private readonly highlighted = new LineSegments2(new LineSegmentsGeometry(), this.accent);
    private paths: Polylines | null = null;

    setTheme(theme: ViewTheme): void {
        this.ink.color.set(theme.ink);
        this.halo.color.set(theme.halo);
        this.accent.color.set(theme.accent);
    }

    setPaths(paths: Polylines | null): void {
        for (const child of [...this.group.children])
            if (child instanceof LineSegments2) child.geometry.dispose();
        this.group.clear();
        this.paths = paths;
        if (!paths || paths.points.length === 0) return;
        const geometry = new LineSegmentsGeometry();
        geometry.setPositions(segments(paths, () => true));
        for (const [material, order] of [
            [this.halo, 1],
            [this.ink, 2],
        ] as const) {
            const lines = new LineSegments2(geometry, material);
            lines.renderOrder = order;
            lines.frustumCulled = false;
            this.group.add(lines);
        }
    }

    /** Highlights the path of one layout edge; null for none. */
    highlight(layoutEdge: number | null): void {
        this.highlighted.removeFromParent();
        this.highlighted.geometry.dispose();
        if (layoutEdge === null || !this.paths) return;
        const positions = segments(this.paths, (edge) => edge === layoutEdge);
        if (positions.length === 0) return;
        this.highlighted.geometry = new LineSegmentsGeometry();
        this.highlighted.geometry.setPositions(positions);
        this.highlighted.renderOrder = 3;
        this.highlighted.frustumCulled = false;
        this.group.add(this.highlighted);
    }
}

function lineMaterial(width: number, layer: number): LineMaterial {
    const material = new LineMaterial({ linewidth: width, depthWrite: false });
    // The paths lie in the surface: they are pulled towards the eye a little, upper layers more.
    material.onBeforeCompile = (shader) => {
        shader.vertexShader = shader.vertexShader.replace(
            "gl_Position = clip;",
            `clip.z -= ${(0.0006 + 0.0002 * layer).toFixed(4)} * clip.w;\n\t\t\tgl_Position = clip;`,
        );
    };
    material.customProgramCacheKey = () => `path layer ${layer}`;
    return material;
}

/** Both ends of every segment of the chosen paths, one after the other. */
function segments(paths: Polylines, chosen: (layoutEdge: number) => boolean): Float32Array {
    let count = 0;
    const each = (use: (from: number) => void) => {
        for (let p = 0; p + 1 < paths.offsets.length; ++p) {
            if (!chosen(paths.layoutEdges[p]!)) continue;
            for (let i = paths.offsets[p]!; i + 1 < paths.offsets[p + 1]!; ++i) use(3 * i);
        }
    };
    each(() => (count += 6));
    const positions = new Float32Array(count);
    let place = 0;
    each((from) => {
        for (let c = 0; c < 6; ++c) positions[place++] = paths.points[from + c]!;
    });
    return positions;
}
