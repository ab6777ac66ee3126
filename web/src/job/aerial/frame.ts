/** Layout of a picture from above. */

import type { Region } from "../region";

const MARGIN = { left: 44, right: 12, top: 10, bottom: 34 };
/** Lowest and highest part of the page that the region takes [px]. */
const LEAST_HEIGHT = 90;
const MOST_HEIGHT = 460;

/** Pixels of a metre, and the height of the picture, for its width. */
export interface Frame {
  scale: number;
  width: number;
  height: number;
  left: number;
  middle: number;
}

/** Layout of a picture as wide as this: equal scales, as large as fits. */
export function frameOf({ low, high }: Region, width: number): Frame {
  const [long, wide] = [high[0] - low[0], high[1] - low[1]];
  const scale = Math.min((width - MARGIN.left - MARGIN.right) / long, MOST_HEIGHT / wide);
  const inner = Math.max(LEAST_HEIGHT, wide * scale);
  const left = MARGIN.left + (width - MARGIN.left - MARGIN.right - long * scale) / 2 - low[0] * scale;
  return {
    scale,
    width,
    left,
    height: inner + MARGIN.top + MARGIN.bottom,
    middle: MARGIN.top + inner / 2 + ((high[1] + low[1]) / 2) * scale,
  };
}

/** Place in the picture [px] of a place on the ground [m]. */
export function placeOn({ left, middle, scale }: Frame): (x: number, y: number) => [number, number] {
  return (x, y) => [left + x * scale, middle - y * scale];
}

/** Draws a line between two places of the picture [px]. */
export function line(context: CanvasRenderingContext2D, from: [number, number], to: [number, number]): void {
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
  context.stroke();
}
