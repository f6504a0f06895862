// The instances of the benchmark. Paths are relative to the data folder; without landmarks, they
// are set by proximity. `quick` marks the ones of `npm run bench -- --quick`, `demanded` those that
// have to be done within the time limit of --check.

const range = (n) => Array.from({ length: n }, (_, i) => i + 1);

function controlMesh(name) {
    return {
        name,
        layout: `data/${name}_control_mesh.obj`,
        target: `data/${name}.obj`,
        quick: name === "penguin",
        demanded: true,
    };
}

function cubeOnSphere(level, seed) {
    return {
        name: `sphere${level} cube ${seed}`,
        layout: "instances/sphere_cube/cube_layout.obj",
        target: `instances/sphere${level}.obj`,
        landmarks: `instances/sphere_cube/sphere${level}_seed${seed}.txt`,
        quick: level === 5 && seed <= 3,
        demanded: true,
    };
}

function icosahedron(percent, seed) {
    return {
        name: `ico p${percent} ${seed}`,
        layout: "instances/icosahedron/icosahedron.obj",
        target: "instances/sphere5.obj",
        landmarks: `instances/icosahedron/ico_p${percent}_s${seed}.txt`,
        quick: percent === 50 && seed === 1,
    };
}

function hull(points, percent) {
    const name = `hull${points}_p${percent}_s1`;
    return {
        name,
        layout: `instances/hull/${name}.obj`,
        target: "instances/sphere5.obj",
        landmarks: `instances/hull/${name}.txt`,
    };
}

export const instances = [
    ...["spot", "penguin"].map(controlMesh),
    ...[5, 6].flatMap((level) => range(10).map((seed) => cubeOnSphere(level, seed))),
    ...[20, 35, 50, 100].flatMap((p) => range(3).map((seed) => icosahedron(p, seed))),
    ...[12, 20, 30].flatMap((points) => [10, 20, 30, 50].map((p) => hull(points, p))),
];
