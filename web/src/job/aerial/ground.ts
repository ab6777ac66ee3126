/** The ground in a picture from above: a channel with its walls, or a part of a terrain. */

import type { Scenario } from "../../api/client";
import type { Region } from "../region";
import type { Theme } from "../use-theme";
import { channelPainter } from "./channel";
import type { Frame } from "./frame";
import { terrainPainter } from "./terrain";

/** Draws in a picture. */
export type Paint = (context: CanvasRenderingContext2D, frame: Frame, theme: Theme) => void;

/** Draws what the flow lies on, and what lies over the flow. */
export interface GroundPainter {
  below: Paint;
  above: Paint;
  /** Least and largest y between which the flow is shown [m]. */
  sides: [number, number];
}

/** Painter of the ground of a scenario. */
export function groundPainter({ channel }: Scenario, region: Region): GroundPainter {
  return channel ? channelPainter(channel, region) : terrainPainter(region);
}
