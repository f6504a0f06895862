// System packages. Only Debian and its relatives are set up automatically; elsewhere the tools have
// to be on the PATH.
import { spawnSync } from "node:child_process";
import { existsSync } from "node:fs";
import path from "node:path";
import { StepError, output, run, say } from "./run.mjs";

/** What each kind of work needs, and the program or file that shows it is there. */
const needs = {
    wasm: {
        cmake: "cmake",
        "ninja-build": "ninja",
        emscripten: "em++",
        // Emscripten's optimiser is a Node program that needs acorn.
        "node-acorn": null,
        "libeigen3-dev": null,
        "libtinyobjloader-dev": null,
    },
    native: {
        cmake: "cmake",
        "ninja-build": "ninja",
        "g++": "g++",
        "libeigen3-dev": null,
        "libtinyobjloader-dev": null,
    },
    test: {
        clang: "clang++",
        // The sanitizers' and libFuzzer's runtime.
        "libclang-rt-14-dev": null,
        "libgtest-dev": null,
        chromium: "chromium",
        "fonts-dejavu-core": null,
    },
    coverage: { llvm: "llvm-cov" },
    lint: { "clang-format": "clang-format" },
    tidy: { "clang-tidy": "clang-tidy", clang: "clang++", "libgtest-dev": null },
};

function notInstalled(debianPackages) {
    // dpkg-query fails for a package it has never heard of, but still prints the others.
    const format = "${Package} ${db:Status-Status}\n";
    const { stdout } = spawnSync("dpkg-query", ["-W", "-f", format, ...debianPackages], {
        encoding: "utf8",
    });
    const lines = stdout.split("\n");
    return debianPackages.filter((name) => !lines.includes(`${name} installed`));
}

function isOnPath(program) {
    return (process.env.PATH ?? "")
        .split(path.delimiter)
        .some((folder) => folder !== "" && existsSync(path.join(folder, program)));
}

/**
 * Installs what is missing for the given kinds of work (keys of `needs`), as root or through
 * password-less sudo; throws with the command to run where neither is possible.
 */
export async function ensureSystemPackages(...kinds) {
    const wanted = Object.assign({}, ...kinds.map((kind) => needs[kind]));
    const names = Object.keys(wanted);
    if (!isOnPath("dpkg-query") || !isOnPath("apt-get")) {
        const absent = names.filter((name) => wanted[name] !== null && !isOnPath(wanted[name]));
        if (absent.length > 0) {
            throw new StepError(
                `this is not a Debian system, so nothing is installed automatically. Install what ` +
                    `Debian calls ${names.join(", ")}; not found on the PATH: ` +
                    `${absent.map((name) => wanted[name]).join(", ")}`,
            );
        }
        return;
    }
    const missing = notInstalled(names);
    if (missing.length === 0) {
        return;
    }
    const install = ["install", "-y", "--no-install-recommends", ...missing];
    const asRoot = process.getuid?.() === 0;
    if (!asRoot && output("sudo", ["-n", "true"]) === null) {
        throw new StepError(
            `system packages are missing, and installing them needs root. Run this once, then try ` +
                `again:\n\n  sudo sh -c 'apt-get update && apt-get ${install.join(" ")}'\n`,
        );
    }
    say(`» system packages: ${missing.join(" ")}`);
    // env(1) because sudo drops the environment.
    const apt = (args) => {
        const command = ["env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "-q", ...args];
        return asRoot ? run(command[0], command.slice(1)) : run("sudo", ["-n", ...command]);
    };
    await apt(["update"]);
    await apt(install);
}

/** The folder of the Emscripten tool chain. */
export function emscriptenRoot() {
    const found = [
        process.env.EMSCRIPTEN_ROOT,
        output("em-config", ["EMSCRIPTEN_ROOT"]),
        "/usr/share/emscripten",
    ].find(
        (place) => place && existsSync(path.join(place, "cmake/Modules/Platform/Emscripten.cmake")),
    );
    if (!found) {
        throw new StepError("Emscripten was not found; set EMSCRIPTEN_ROOT to its folder");
    }
    return found;
}
