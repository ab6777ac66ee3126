/** Names of quantities and inputs as people read them. */

import { tokens } from "../parts/json-document";
import { wordsOfKey } from "../parts/words";

const NAMES: Record<string, string> = {
  rest_x_m: "x of the resting place",
  rest_y_m: "y of the resting place",
  rest_z_m: "height of the resting place",
  buried_m: "depth below the surface",
  front_m: "front of the flow",
  runout_m: "run-out of the flow",
  outflow_mass_kg: "mass that flowed out",
  hit: "hit by the flow (1 yes, 0 no)",
  moving: "still moving (1 yes, 0 no)",
  point_steps: "work in point-steps",
  wall_s: "wall time",
};

/** Name of a quantity, such as `peak speed`. */
export function nameOf(quantity: string): string {
  return NAMES[quantity] ?? wordsOfKey(quantity);
}

/** Name of a quantity of a body, or of the whole run. */
export function ofBody(quantity: string, body: number | null | undefined): string {
  return body === null || body === undefined ? nameOf(quantity) : `${nameOf(quantity)} of body ${body}`;
}

/** Name of a quantity with its unit, as the title of an axis or a column. */
export function titled(name: string, unit: string): string {
  return unit === "" ? name : `${name} [${unit}]`;
}

/** Name of a place in the scenario, such as `body 0, position, lateral`. */
export function placeName(pointer: string): string {
  const words: string[] = [];
  for (const key of tokens(pointer)) {
    const last = words.length - 1;
    if (/^\d+$/.test(key) && last >= 0) words[last] = `${words[last]?.replace(/ies$/, "y")} ${key}`;
    else words.push(wordsOfKey(key));
  }
  return words.join(", ");
}

/** Last key of a pointer, whose name carries the unit. */
export function lastKey(pointer: string): string {
  return tokens(pointer).at(-1) ?? "";
}
