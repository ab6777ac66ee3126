/** The part of the channel where something happens. */

import type { Scenario } from "../api/client";
import { surfaceOf } from "../geometry/surface";
import { length } from "../geometry/vectors";
import type { FlowFrame } from "./flow/decoder";
import type { Poses } from "./records/trajectories";

/** A box along the axes [m]. */
export interface Region {
  low: [number, number, number];
  high: [number, number, number];
}

/** Box that holds the flow and the bodies at all times, and the width of the channel. */
export function regionOf(scenario: Scenario, poses: Poses[], frames: FlowFrame[]): Region {
  const { channel } = scenario;
  const half = channel.width_m / 2;
  const region: Region = { low: [Infinity, -half, 0], high: [-Infinity, half, 0] };
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
  if (region.low[0] > region.high[0]) {
    region.low[0] = -channel.incline_length_m;
    region.high[0] = channel.runout_length_m;
  }
  const margin = 0.04 * (region.high[0] - region.low[0]);
  region.low[0] = Math.max(-channel.incline_length_m, region.low[0] - margin);
  region.high[0] += margin;
  region.high[2] = Math.max(region.high[2], region.low[2] + 1e-6);
  return region;
}

function include({ low, high }: Region, from: readonly number[], to: readonly number[], reach: number): void {
  for (const axis of [0, 1, 2] as const) {
    low[axis] = Math.min(low[axis], (from[axis] ?? 0) - reach);
    high[axis] = Math.max(high[axis], (to[axis] ?? 0) + reach);
  }
}
