/** A part of a terrain from above: a plain field with metres east and north. */

import { figure } from "../../parts/format";
import { multiples, niceStep } from "../../parts/round-values";
import type { Region } from "../region";
import { line, placeOn } from "./frame";
import type { GroundPainter, Paint } from "./ground";

/** Digits of a number on an axis: maps are large beside what happens on them. */
const DIGITS = 6;
/** Distance of numbers along the axes [px]. */
const APART = { east: 110, north: 60 };

/** Painter of the part of a terrain in a region. */
export function terrainPainter(region: Region): GroundPainter {
  const { low, high } = region;
  const axes = paintAxes(region);
  return {
    below: (context, frame, theme) => {
      const at = placeOn(frame);
      const [[x0, y0], [x1, y1]] = [at(low[0], high[1]), at(high[0], low[1])];
      context.fillStyle = theme.raised;
      context.fillRect(x0, y0, x1 - x0, y1 - y0);
      context.strokeStyle = theme.line;
      context.lineWidth = 1;
      context.strokeRect(x0, y0, x1 - x0, y1 - y0);
    },
    above: axes,
    sides: [low[1], high[1]],
  };
}

function paintAxes({ low, high }: Region): Paint {
  return (context, frame, theme) => {
    const at = placeOn(frame);
    const [left, base] = at(low[0], low[1]);
    const [right, top] = at(high[0], high[1]);
    const step = (length: number, pixels: number, apart: number) => niceStep(length, Math.max(2, pixels / apart));
    context.fillStyle = theme.quiet;
    context.strokeStyle = theme.quiet;
    context.lineWidth = 1;
    context.font = "12px system-ui, sans-serif";
    context.textAlign = "center";
    for (const x of multiples(step(high[0] - low[0], right - left, APART.east), low[0], high[0])) {
      context.fillText(`${figure(x, DIGITS)} m`, at(x, 0)[0], base + 18);
      line(context, [at(x, 0)[0], base], [at(x, 0)[0], base + 5]);
    }
    context.textAlign = "right";
    for (const y of multiples(step(high[1] - low[1], base - top, APART.north), low[1], high[1])) {
      context.fillText(figure(y, DIGITS), left - 8, at(0, y)[1] + 4);
      line(context, [left - 5, at(0, y)[1]], [left, at(0, y)[1]]);
    }
    context.fillText("east →", right - 6, base - 6);
    context.textAlign = "left";
    context.fillText("↑ north", left + 6, top + 15);
  };
}
