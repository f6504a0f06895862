// One task of an experiment, for pool.mjs.
import { childSeconds, processSeconds } from "../bench/process.mjs";
import { embeddingCount } from "./solving.mjs";
import { setPictureFolder } from "./drawing/picture.mjs";

process.once("message", async ({ experiment, task, input, folder }) => {
    setPictureFolder(folder);
    const { tasks } = await import(`./${experiment}.mjs`);
    const result = await tasks[task](input);
    const answer = {
        result,
        cpuSeconds: processSeconds() + childSeconds(),
        embeddings: embeddingCount(),
    };
    process.send(answer, () => process.disconnect());
});
