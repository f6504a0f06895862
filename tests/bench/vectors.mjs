// Vectors as arrays of three numbers.

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

export const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];

export const cross = (a, b) => [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0],
];

export const times = (s, a) => [s * a[0], s * a[1], s * a[2]];

export const normalized = (a) => times(1 / Math.sqrt(dot(a, a)), a);
