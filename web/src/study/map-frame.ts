/** What a map of resting places shows beside them: the ground, the start, and its ranges. */

import { type JsonObject, at } from "../parts/json-document";
import { type Ground, groundOf } from "../scenario/ground";
import { sceneOf } from "../scenario/scene";
import type { Schemas } from "../scenario/schema";
import type { Place, RestDistribution } from "./documents";
import { type MapScale, type Range, mapScale, rangeOf } from "./scales";

/** What lies round the resting places of a body, seen from above [m]. */
export interface Surroundings {
  ground: Ground;
  /** The channel; undefined on a terrain. */
  channel: ChannelOutline | undefined;
  /** Place of the body at the start, as far as it is known in the coordinates of the map. */
  start: Place | undefined;
}

/** A channel from above [m]. */
export interface ChannelOutline {
  /** Side walls at ± this. */
  halfWidth: number;
  /** Upper end of the incline and end of the floor. */
  ends: Range;
  /** True if there is an incline, whose foot is at 0. */
  hasFoot: boolean;
}

/** Surroundings in a scenario; none if it lacks what every scenario has. */
export function surroundingsOf(scenario: JsonObject, body: number, schemas: Schemas): Surroundings | undefined {
  if (groundOf(scenario) === "terrain")
    return { ground: "terrain", channel: undefined, start: localStart(scenario, body) };
  const scene = sceneOf(scenario, schemas);
  if (!scene) return undefined;
  const { incline, runout, width, inclination } = scene.channel;
  const [x, y] = scene.bodies.find(({ index }) => index === body)?.centre ?? [];
  return {
    ground: "channel",
    channel: { halfWidth: 0.5 * width, ends: [-incline, runout], hasFoot: inclination > 0 },
    start: x !== undefined && y !== undefined ? [x, y] : undefined,
  };
}

/** Start of a body whose place is given in local coordinates, as resting places are. */
function localStart(scenario: JsonObject, body: number): Place | undefined {
  if (at(scenario, "/terrain/coordinates") !== "local") return undefined;
  const [east, north] = ["east_m", "north_m"].map((key) => at(scenario, `/bodies/${body}/position/${key}`));
  return typeof east === "number" && typeof north === "number" ? [east, north] : undefined;
}

/** Scale of a map that shows all places, regions, the start, and a channel's whole width. */
export function frameOf(
  rest: RestDistribution,
  places: Place[],
  around: Surroundings | undefined,
  width: number,
): MapScale {
  const corners = rest.regions.flatMap(({ polygons }) => polygons.flatMap(({ outer_m }) => outer_m as Place[]));
  const atoms = rest.atoms.map(({ place_m }) => place_m as Place);
  const all = [...corners, ...places, ...atoms, ...(around?.start ? [around.start] : [])];
  const x = rangeOf(
    all.map(([x]) => x),
    0.08,
  );
  const y = rangeOf(
    all.map(([, y]) => y),
    0.08,
  );
  if (!around?.channel) return mapScale(x, y, width);
  const half = 1.06 * around.channel.halfWidth;
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
