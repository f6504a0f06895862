import { pngOf, type Viewer } from "./viewer.js";

/** What one or more views show, side by side, as a PNG. */
export async function pictureOf(views: readonly Viewer[]): Promise<Blob> {
    const pictures = await Promise.all(views.map((view) => view.screenshot()));
    const [only] = pictures;
    if (pictures.length === 1 && only) return only;
    const images = await Promise.all(pictures.map((picture) => createImageBitmap(picture)));
    const canvas = document.createElement("canvas");
    canvas.width = images.reduce((sum, { width }) => sum + width, 0);
    canvas.height = Math.max(...images.map(({ height }) => height));
    const context = canvas.getContext("2d");
    let left = 0;
    for (const image of images) {
        context?.drawImage(image, left, 0);
        left += image.width;
    }
    return pngOf(canvas);
}
