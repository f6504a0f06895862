// npm start: sets everything up, builds the page and serves it.
//   npm start -- [--port N]      (or PORT=N npm start)
import { parseArgs } from "node:util";
import { buildPackage, buildPage, installPackages } from "./build.mjs";
import { StepError, main, root } from "./run.mjs";

await main(async () => {
    const port = wantedPort();
    await installPackages();
    await buildPackage();
    await buildPage();
    // Not before now: Vite is one of the packages just installed.
    const { preview } = await import("vite");
    // A port that was asked for is taken or it is an error; otherwise the next free one will do.
    const server = await preview({
        root: `${root}/web`,
        preview: { host: "127.0.0.1", port: port ?? 4173, strictPort: port !== null },
    }).catch((error) => {
        throw new StepError(`the page cannot be served: ${error.message}`);
    });
    console.log(`\nThe page is at ${server.resolvedUrls.local[0]} (Ctrl+C ends)`);
});

function wantedPort() {
    let asked;
    try {
        const { values } = parseArgs({ options: { port: { type: "string", short: "p" } } });
        asked = values.port ?? process.env.PORT;
    } catch (error) {
        throw new StepError(`${error.message} (usage: npm start -- [--port N])`);
    }
    if (asked === undefined || asked === "") {
        return null;
    }
    const port = Number(asked);
    if (!Number.isInteger(port) || port < 1 || port > 65535) {
        throw new StepError(`${asked} is no port: give a number from 1 to 65535`);
    }
    return port;
}
