// npm run cli -- …: the package's command line, built first if need be. With npm's --silent, nothing
// but the command's own output is printed.
import { spawn } from "node:child_process";
import path from "node:path";
import { buildPackage, commandLine, installPackages } from "./build.mjs";
import { beQuiet, main, root } from "./run.mjs";

await main(async () => {
    beQuiet();
    await installPackages();
    await buildPackage();
    return new Promise((resolve) => {
        // npm changes to the project's root; paths are meant from where the user called it.
        const child = spawn(
            process.execPath,
            [path.join(root, commandLine()), ...process.argv.slice(2)],
            { cwd: process.env.INIT_CWD ?? process.cwd(), stdio: "inherit" },
        );
        // Ctrl+C reaches the whole process group: the command ends by itself, writes what it has,
        // and its exit code is ours.
        for (const signal of ["SIGINT", "SIGTERM"]) {
            process.on(signal, () => signal === "SIGTERM" && child.kill(signal));
        }
        child.on("close", (code, signal) => resolve(code ?? (signal === "SIGINT" ? 130 : 5)));
    });
});
