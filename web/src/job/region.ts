/** The part of the ground where something happens. */

import type { Scenario, Schemas } from "../api/client";
import { surfaceOf } from "../geometry/surface";
import { length } from "../geometry/vectors";
import type { FlowFrame } from "./flow/decoder";
import type { Poses } from "./records/trajectories";

/** A box along the axes [m]. */
export interface Region {
  low: [number, number, number];
  high: [number, number, number];
}

/** Share of its length that a region has as a margin at either end. */
const MARGIN = 0.04;

/** Box that holds the flow and the bodies at all times, and the width of a channel. */
export function regionOf(scenario: Scenario, poses: Poses[], frames: FlowFrame[]): Region {
  const { channel } = scenario;
  const region = channel ? acrossChannel(channel) : nowhere();
  for (const { origin, extent, kept } of frames) {
    if (kept > 0) include(region, origin, [origin[0] + extent[0], origin[1] + extent[1], origin[2] + extent[2]], 0);
  }
  for (const { body, position } of poses) {
    const given = scenario.bodies[body];
    if (!given) continue;
    const { core, radius } = surfaceOf(given);
    const reach = radius + Math.max(...core.map(length));
    for (const place of position) include(region, place, place, reach);
  }
  if (channel) fitChannel(region, channel);
  else fitTerrain(region);
  region.high[2] = Math.max(region.high[2], region.low[2] + 1e-6);
  return region;
}

function acrossChannel({ width_m: width }: Schemas["Channel"]): Region {
  return { low: [Infinity, -width / 2, 0], high: [-Infinity, width / 2, 0] };
}

function nowhere(): Region {
  return { low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity] };
}

/** Gives a region in a channel its margins, as far as the channel reaches; all of it if nothing is there. */
function fitChannel(region: Region, channel: Schemas["Channel"]): void {
  if (region.low[0] > region.high[0]) {
    region.low[0] = -channel.incline_length_m;
    region.high[0] = channel.runout_length_m;
  }
  const margin = MARGIN * (region.high[0] - region.low[0]);
  region.low[0] = Math.max(-channel.incline_length_m, region.low[0] - margin);
  region.high[0] += margin;
}

/** Gives a region on a terrain its margins; a metre at the map's corner if nothing is there. */
function fitTerrain(region: Region): void {
  if (region.low[0] > region.high[0]) include(region, [0, 0, 0], [1, 1, 1], 0);
  const margin = MARGIN * Math.max(region.high[0] - region.low[0], region.high[1] - region.low[1]);
  for (const axis of [0, 1] as const) {
    region.low[axis] -= margin;
    region.high[axis] += margin;
  }
}

function include({ low, high }: Region, from: readonly number[], to: readonly number[], reach: number): void {
  for (const axis of [0, 1, 2] as const) {
    low[axis] = Math.min(low[axis], (from[axis] ?? 0) - reach);
    high[axis] = Math.max(high[axis], (to[axis] ?? 0) + reach);
  }
}
