/** What a map of resting places shows beside them: channel, start, and its ranges. */

import type { Place, RestDistribution } from "./documents";
import { type MapScale, type Range, mapScale, rangeOf } from "./scales";

/** Channel and start of a body, seen from above [m]. */
export interface Ground {
  /** Side walls at ± this. */
  halfWidth: number;
  /** Upper end of the incline and end of the floor. */
  ends: Range;
  /** True if there is an incline, whose foot is at 0. */
  hasFoot: boolean;
  start: Place | undefined;
}

const WIDTH_OF_CHANNEL = 0.2;

/** Ground of a scenario; none if it does not have what every scenario has. */
export function groundOf(scenario: unknown, body: number): Ground | undefined {
  const { channel, bodies } = scenario as {
    channel?: { incline_length_m?: number; runout_length_m?: number; width_m?: number; inclination_deg?: number };
    bodies?: {
      shape?: Record<string, { side_m?: number; sides_m?: number[] }>;
      position?: { downstream_m?: number; lateral_m?: number };
    }[];
  };
  if (channel?.incline_length_m === undefined || channel.runout_length_m === undefined) return undefined;
  const { position, shape } = bodies?.[body] ?? {};
  // The default place is a side's length away from the foot.
  const side = shape?.["cube"]?.side_m ?? Math.max(...(shape?.["box"]?.sides_m ?? [Number.NaN]));
  const downstream = position?.downstream_m ?? side;
  return {
    halfWidth: 0.5 * (channel.width_m ?? WIDTH_OF_CHANNEL),
    ends: [-channel.incline_length_m, channel.runout_length_m],
    hasFoot: (channel.inclination_deg ?? 0) > 0,
    start: Number.isFinite(downstream) ? [downstream, position?.lateral_m ?? 0] : undefined,
  };
}

/** Scale of a map that shows all places, regions, the start, and the channel's whole width. */
export function frameOf(rest: RestDistribution, places: Place[], ground: Ground | undefined, width: number): MapScale {
  const corners = rest.regions.flatMap(({ polygons }) => polygons.flatMap(({ outer_m }) => outer_m as Place[]));
  const atoms = rest.atoms.map(({ place_m }) => place_m as Place);
  const all = [...corners, ...places, ...atoms, ...(ground?.start ? [ground.start] : [])];
  const x = rangeOf(
    all.map(([x]) => x),
    0.08,
  );
  const y = rangeOf(
    all.map(([, y]) => y),
    0.08,
  );
  const half = 1.06 * (ground?.halfWidth ?? 0);
  return mapScale(x, [Math.min(y[0], -half), Math.max(y[1], half)], width);
}

/** A label of a region beside its outline [px]. */
export interface Label {
  text: string;
  at: Place;
}

/** Directions in which the labels of regions stand, so that they keep apart. */
const DIRECTIONS = [-0.35, 0.35, -1.1, 1.1, 2.4, -2.4];
/** Least distance of two labels [px]. */
const APART: Place = [40, 14];

/** Labels at the outlines of regions, each at the corner furthest in a direction of its own; those
 * that would cover another are left out, since the legend names all. */
export function labelsOf(outlines: { text: string; corners: Place[] }[]): Label[] {
  const placed: Label[] = [];
  outlines.forEach(({ text, corners }, number) => {
    for (let turn = 0; turn < DIRECTIONS.length; turn += 1) {
      const angle = DIRECTIONS[(number + turn) % DIRECTIONS.length] ?? 0;
      const at = furthest(corners, angle);
      if (
        at &&
        placed.every((other) => Math.abs(other.at[0] - at[0]) > APART[0] || Math.abs(other.at[1] - at[1]) > APART[1])
      ) {
        placed.push({ text, at });
        return;
      }
    }
  });
  return placed;
}

function furthest(corners: Place[], angle: number): Place | undefined {
  const reach = ([x, y]: Place) => x * Math.cos(angle) + y * Math.sin(angle);
  return corners.reduce<Place | undefined>(
    (best, corner) => (best && reach(best) >= reach(corner) ? best : corner),
    undefined,
  );
}
