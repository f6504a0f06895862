import {
    Box3,
    Color,
    DirectionalLight,
    Group,
    HemisphereLight,
    PerspectiveCamera,
    Plane,
    Raycaster,
    Scene,
    Sphere,
    Spherical,
    Vector2,
    Vector3,
    WebGLRenderer,
    type Ray,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

/** A canvas as a PNG. */
export function pngOf(canvas: HTMLCanvasElement): Promise<Blob> {
    return new Promise((resolve, reject) => {
        canvas.toBlob((blob) => {
            if (blob) resolve(blob);
            else reject(new Error("the picture could not be encoded"));
        }, "image/png");
    });
}

/** Where a camera stands, independent of what it looks at. */
export interface Pose {
    /** Unit vector from the centre of attention to the eye. */
    readonly direction: Vector3;
    /** Distance of the eye, relative to that from which all is seen. */
    readonly distance: number;
}

/** Degrees; the narrow one is as good as parallel. */
const perspectiveAngle = 35;
const parallelAngle = 1.5;

const startDirection = new Vector3(0.62, 0.38, 0.78).normalize();

/**
 * A 3D view in a host element: scene, camera, pointer and key control. It draws only when asked to,
 * never in a loop of its own.
 */
export class Viewer {
    readonly content = new Group();
    readonly canvas: HTMLCanvasElement;
    readonly renderer: WebGLRenderer;
    readonly camera = new PerspectiveCamera(perspectiveAngle, 1, 0.01, 100);
    /** Called when a person has moved the camera, not after setPose(). */
    onPoseChange: (() => void) | null = null;
    /** Radius of what is shown. */
    radius = 1;

    private readonly scene = new Scene();
    private readonly controls: OrbitControls;
    private frame = 0;
    private following = false;

    /** Throws if WebGL is not available. */
    constructor(
        private readonly host: HTMLElement,
        label: string,
    ) {
        this.renderer = new WebGLRenderer({ antialias: true, powerPreference: "high-performance" });
        this.renderer.localClippingEnabled = true;
        this.canvas = this.renderer.domElement;
        this.canvas.tabIndex = 0;
        // An application: screen readers then leave the arrow keys to it.
        this.canvas.setAttribute("role", "application");
        this.canvas.setAttribute("aria-label", label);
        host.prepend(this.canvas);

        const headlight = new DirectionalLight(0xffffff, 1.55);
        headlight.position.set(-0.5, 0.9, 1.2);
        const fill = new DirectionalLight(0xffffff, 0.45);
        fill.position.set(1, -0.4, 0.3);
        this.camera.add(headlight, fill);
        const sky = new HemisphereLight(0xffffff, 0xa9b4c6, 1.5);
        this.scene.add(this.camera, sky, this.content);

        this.controls = new OrbitControls(this.camera, this.canvas);
        this.controls.enableDamping = false;
        this.controls.zoomToCursor = true;
        this.controls.addEventListener("change", () => {
            this.requestRender();
            if (!this.following) this.onPoseChange?.();
        });
        this.canvas.addEventListener("keydown", (event) => this.handleKey(event));
        new ResizeObserver(() => this.resize()).observe(host);
        this.resetView();
    }

    /** Points the camera at what is shown: 3 coordinates per vertex. */
    frameOn(positions: ArrayLike<number>): void {
        const sphere = boundingSphere(positions);
        this.radius = sphere.radius > 0 ? sphere.radius : 1;
        this.center.copy(sphere.center);
        this.center.add(this.offCentre(sampled(positions, this.center, this.radius)));
        this.silhouette = sampled(positions, this.center, this.radius);
        this.resetView();
    }

    /** Brings a place into the middle, with what is around it up to a radius. */
    focusOn(place: Vector3, radius: number, direction: Vector3): void {
        this.controls.target.copy(place);
        const tangent = Math.tan(((this.camera.fov / 2) * Math.PI) / 180);
        // Straight from above or below, which way is up would be open.
        const side = direction.clone().addScaledVector(startDirection, 0.4).normalize();
        this.moveTo(side.lengthSq() > 0 ? side : startDirection, (1.2 * radius) / tangent);
        this.onPoseChange?.();
    }

    /** Shows everything again, from the side it is seen from now. */
    fit(): void {
        this.controls.target.copy(this.center);
        const { direction } = this.pose();
        this.moveTo(direction, this.fittingDistance(direction));
        this.onPoseChange?.();
    }

    /** Parallel projection, or perspective. */
    setParallel(on: boolean): void {
        const pose = this.pose();
        this.camera.fov = on ? parallelAngle : perspectiveAngle;
        this.camera.updateProjectionMatrix();
        this.setPose(pose);
    }

    /** A plane that cuts away a share of what is shown from the side of the eye; null for none. */
    cutPlane(share: number): Plane | null {
        if (share <= 0) return null;
        const { direction } = this.pose();
        const point = this.center.clone().addScaledVector(direction, (1 - 2 * share) * this.radius);
        return new Plane().setFromNormalAndCoplanarPoint(direction.clone().negate(), point);
    }

    /** The line of sight through a point of the canvas, in CSS pixels. */
    ray(x: number, y: number): Ray {
        const { clientWidth, clientHeight } = this.canvas;
        this.camera.updateMatrixWorld();
        const at = new Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight);
        this.caster.setFromCamera(at, this.camera);
        return this.caster.ray;
    }

    /** Unit vector in space for a direction on the screen, y upwards. */
    onScreen(x: number, y: number): Vector3 {
        this.camera.updateMatrixWorld();
        const right = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0);
        const up = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, 1);
        return right.multiplyScalar(x).addScaledVector(up, y).normalize();
    }

    /** Whether dragging turns the view. */
    set turning(on: boolean) {
        this.controls.enabled = on;
    }

    setBackground(color: string): void {
        this.scene.background = new Color(color);
        this.requestRender();
    }

    resetView(): void {
        this.controls.target.copy(this.center);
        this.moveTo(startDirection, this.fittingDistance(startDirection));
    }

    pose(): Pose {
        const offset = this.camera.position.clone().sub(this.controls.target);
        const length = offset.length();
        return {
            direction: offset.divideScalar(length),
            distance: length / this.fittingDistance(startDirection),
        };
    }

    /** Looks from the same side and as near as another view does. */
    setPose(pose: Pose): void {
        this.following = true;
        this.moveTo(pose.direction, pose.distance * this.fittingDistance(startDirection));
        this.following = false;
    }

    requestRender(): void {
        if (this.frame === 0) this.frame = requestAnimationFrame(() => this.render());
    }

    /** The picture as a PNG. */
    screenshot(): Promise<Blob> {
        // The drawing buffer is only readable right after drawing.
        this.render();
        return pngOf(this.canvas);
    }

    /** Frames drawn so far: shows in tests that nothing is drawn in a loop. */
    get frames(): number {
        return this.renderer.info.render.frame;
    }

    private readonly caster = new Raycaster();
    private readonly center = new Vector3();
    /** Some of the vertices, relative to the centre, in radii. */
    private silhouette: readonly Vector3[] = [];

    private render(): void {
        cancelAnimationFrame(this.frame);
        this.frame = 0;
        const distance = this.camera.position.distanceTo(this.center);
        this.camera.near = Math.max(distance - 1.5 * this.radius, 0.01 * this.radius);
        this.camera.far = distance + 1.5 * this.radius;
        this.camera.updateProjectionMatrix();
        this.renderer.render(this.scene, this.camera);
    }

    /** How far the middle of some points' picture, from the first side, is off the middle of the view. */
    private offCentre(points: readonly Vector3[]): Vector3 {
        const { right, up } = this.screenAxes(startDirection);
        // About as near as the eye will be; the farther, the smaller.
        const distance = 1 / Math.tan(((this.camera.fov / 2) * Math.PI) / 180);
        const offset = new Vector3();
        for (const axis of [right, up]) {
            const places = points.map(
                (point) => point.dot(axis) / (1 - point.dot(startDirection) / distance),
            );
            const middle =
                places.length > 0 ? (maximum(places) - maximum(places.map(negated))) / 2 : 0;
            offset.addScaledVector(axis, middle * this.radius);
        }
        return offset;
    }

    private screenAxes(direction: Vector3): { right: Vector3; up: Vector3 } {
        const right = new Vector3().crossVectors(this.camera.up, direction).normalize();
        return { right, up: new Vector3().crossVectors(direction, right) };
    }

    /** How far from the centre the eye has to be, on one side, to see everything. */
    private fittingDistance(direction: Vector3): number {
        const tangent = Math.tan(((this.camera.fov / 2) * Math.PI) / 180);
        const { right, up } = this.screenAxes(direction);
        let distance = 1;
        for (const point of this.silhouette) {
            const toward = point.dot(direction);
            const x = Math.abs(point.dot(right)) / (tangent * this.camera.aspect);
            const y = Math.abs(point.dot(up)) / tangent;
            distance = Math.max(distance, toward + 1.14 * Math.max(x, y));
        }
        return distance * this.radius;
    }

    private moveTo(direction: Vector3, distance: number): void {
        const fitting = this.fittingDistance(startDirection);
        this.controls.minDistance = 0.02 * fitting;
        this.controls.maxDistance = 8 * fitting;
        this.camera.position.copy(this.controls.target).addScaledVector(direction, distance);
        this.controls.update();
        this.requestRender();
    }

    private resize(): void {
        const { clientWidth: width, clientHeight: height } = this.host;
        if (width === 0 || height === 0) return;
        const { distance } = this.pose();
        const ratio = Math.min(devicePixelRatio, 2);
        this.renderer.setPixelRatio(ratio);
        this.renderer.setSize(width, height);
        this.camera.aspect = width / height;
        this.setPose({ direction: this.pose().direction, distance });
    }

    private handleKey(event: KeyboardEvent): void {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const step = Math.PI / 24;
        const turns: Record<string, [number, number]> = {
            ArrowLeft: [-step, 0],
            ArrowRight: [step, 0],
            ArrowUp: [0, -step],
            ArrowDown: [0, step],
        };
        const offset = this.camera.position.clone().sub(this.controls.target);
        const turn = event.shiftKey ? undefined : turns[event.key];
        if (turn) {
            const spherical = new Spherical().setFromVector3(offset);
            spherical.theta += turn[0];
            spherical.phi += turn[1];
            spherical.makeSafe();
            offset.setFromSpherical(spherical);
        } else if (event.key === "+" || event.key === "=") {
            offset.multiplyScalar(0.88);
        } else if (event.key === "-") {
            offset.divideScalar(0.88);
        } else {
            return;
        }
        event.preventDefault();
        this.moveTo(offset.clone().normalize(), offset.length());
    }
}

const negated = (value: number) => -value;
const maximum = (values: readonly number[]) => values.reduce((a, b) => Math.max(a, b), -Infinity);

function boundingSphere(positions: ArrayLike<number>): Sphere {
    const box = new Box3();
    const point = new Vector3();
    for (let i = 0; i < positions.length; i += 3)
        box.expandByPoint(point.set(positions[i]!, positions[i + 1]!, positions[i + 2]));
    return box.isEmpty() ? new Sphere(new Vector3(), 1) : box.getBoundingSphere(new Sphere());
}

function sampled(positions: ArrayLike<number>, center: Vector3, radius: number): Vector3[] {
    const points: Vector3[] = [];
    const stride = 3 * Math.max(1, Math.floor(positions.length / 3 / 2000));
    for (let i = 0; i < positions.length; i += stride)
        points.push(
            new Vector3(positions[i], positions[i + 1], positions[i + 2])
                .sub(center)
                .divideScalar(radius),
        );
    return points;
}
