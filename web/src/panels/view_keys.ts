/** What every 3D view says of its keys. */
export const viewKeys = "Arrow keys turn it, plus and minus zoom.";

/** Directions on the screen, y upwards. */
export const arrowSteps: Readonly<Record<string, readonly [x: number, y: number]>> = {
    ArrowLeft: [-1, 0],
    ArrowRight: [1, 0],
    ArrowUp: [0, 1],
    ArrowDown: [0, -1],
};
