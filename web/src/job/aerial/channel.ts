/** A channel from above: its walls, its foot and metres along it. */

import type { Schemas } from "../../api/client";
import { figure } from "../../parts/format";
import { multiples, niceStep } from "../../parts/round-values";
import type { Region } from "../region";
import { type Frame, line, placeOn } from "./frame";
import type { GroundPainter, Paint } from "./ground";

type Channel = Schemas["Channel"];

/** Painter of the part of a channel in a region. */
export function channelPainter(channel: Channel, region: Region): GroundPainter {
  const half = channel.width_m / 2;
  const [walls, axis] = [paintWalls(channel, region), paintAxis(half, region)];
  return {
    below: (context, frame, theme) => {
      const [x0, y0, x1, y1] = corners(frame, channel, region);
      context.fillStyle = theme.raised;
      context.fillRect(x0, y0, x1 - x0, y1 - y0);
    },
    above: (context, frame, theme) => {
      walls(context, frame, theme);
      axis(context, frame, theme);
    },
    sides: [-half, half],
  };
}

/** Corners of the channel's part of the picture. */
function corners(frame: Frame, channel: Channel, { low, high }: Region): [number, number, number, number] {
  const at = placeOn(frame);
  const half = channel.width_m / 2;
  return [...at(low[0], half), ...at(Math.min(channel.runout_length_m, high[0]), -half)];
}

function paintWalls(channel: Channel, region: Region): Paint {
  const { low, high } = region;
  return (context, frame, theme) => {
    const [x0, y0, x1, y1] = corners(frame, channel, region);
    context.strokeStyle = theme.ground;
    context.lineWidth = 2;
    line(context, [x0, y0], [x1, y0]);
    line(context, [x0, y1], [x1, y1]);
    if (low[0] <= -channel.incline_length_m) line(context, [x0, y0], [x0, y1]);
    context.lineWidth = 1;
    context.setLineDash([2, 3]);
    if (high[0] >= channel.runout_length_m) line(context, [x1, y0], [x1, y1]);
    context.setLineDash([6, 4]);
    const [foot] = placeOn(frame)(0, 0);
    if (low[0] < 0 && high[0] > 0) line(context, [foot, y0], [foot, y1]);
    context.setLineDash([]);
  };
}

function paintAxis(half: number, { low, high }: Region): Paint {
  return (context, frame, theme) => {
    const at = placeOn(frame);
    context.fillStyle = theme.quiet;
    context.font = "12px system-ui, sans-serif";
    context.textAlign = "center";
    const base = at(0, -half)[1] + 16;
    for (const x of multiples(niceStep(high[0] - low[0], Math.max(3, frame.width / 110)), low[0], high[0])) {
      context.fillText(x === 0 ? "0 m, foot" : `${figure(x)} m`, at(x, 0)[0], base);
      line(context, [at(x, 0)[0], base - 16], [at(x, 0)[0], base - 12]);
    }
    context.textAlign = "right";
    for (const y of [half, -half]) context.fillText(`${figure(y, 2)}`, at(low[0], 0)[0] - 6, at(0, y)[1] + 4);
  };
}
