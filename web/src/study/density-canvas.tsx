import { useEffect, useRef } from "preact/hooks";
import type { RestDistribution } from "./documents";
import { type MapScale, onMap } from "./scales";

/** Opacity of the largest density, so that outlines and places stay visible on it. */
const MOST_OPAQUE = 0.75;

/** Least width of what is drawn [px]. */
const THINNEST = 6;

/** Density of resting places below the map, the more opaque the more probable. */
export function DensityCanvas({ density, scale }: { density: RestDistribution["density"]; scale: MapScale }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const draw = () => canvas.current && paint(canvas.current, density, scale);
    draw();
    const theme = matchMedia("(prefers-color-scheme: dark)");
    theme.addEventListener("change", draw);
    return () => theme.removeEventListener("change", draw);
  }, [density, scale]);
  return <canvas ref={canvas} class="under" width={scale.width} height={scale.height} aria-hidden="true" />;
}

function paint(canvas: HTMLCanvasElement, density: RestDistribution["density"], scale: MapScale): void {
  const context = canvas.getContext("2d");
  if (!context) return;
  context.globalCompositeOperation = "source-over";
  context.clearRect(0, 0, canvas.width, canvas.height);
  const {
    nodes: [nx = 0, ny = 0] = [],
    origin_m: [x0 = 0, y0 = 0] = [],
    spacing_m: [dx = 0, dy = 0] = [],
  } = density ?? {};
  if (!density || nx === 0 || ny === 0) return;
  const [left, top] = onMap(scale, [x0 - 0.5 * dx, y0 + (ny - 0.5) * dy]);
  const [right, bottom] = onMap(scale, [x0 + (nx - 0.5) * dx, y0 - 0.5 * dy]);
  context.imageSmoothingEnabled = true;
  context.imageSmoothingQuality = "high";
  // Bodies that rest on a line have a density without a width.
  const [width, height] = [Math.max(right - left, THINNEST), Math.max(bottom - top, THINNEST)];
  const [x, y] = [0.5 * (left + right - width), 0.5 * (top + bottom - height)];
  context.drawImage(maskOf(density.density_per_m2, nx, ny), x, y, width, height);
  // The mask takes the theme's colour.
  context.globalCompositeOperation = "source-in";
  context.fillStyle = getComputedStyle(canvas).getPropertyValue("--accent");
  context.fillRect(0, 0, canvas.width, canvas.height);
}

/** Picture of a node per pixel, across growing upwards, whose opacity is the density. */
function maskOf(densities: number[], nx: number, ny: number): HTMLCanvasElement {
  const mask = document.createElement("canvas");
  [mask.width, mask.height] = [nx, ny];
  const context = mask.getContext("2d");
  if (!context) return mask;
  const image = context.createImageData(nx, ny);
  const most = densities.reduce((most, value) => Math.max(most, value), 0);
  densities.forEach((value, node) => {
    const row = ny - 1 - Math.floor(node / nx);
    image.data[4 * (row * nx + (node % nx)) + 3] = most > 0 ? 255 * MOST_OPAQUE * (value / most) : 0;
  });
  context.putImageData(image, 0, 0);
  return mask;
}
