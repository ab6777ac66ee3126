/** Names of quantities and inputs as people read them, with the units that their keys carry. */

import { tokens } from "../parts/json-document";

const UNITS: [suffix: string, unit: string][] = [
  ["_rad_s", "rad/s"],
  ["_m_s2", "m/s²"],
  ["_m_s", "m/s"],
  ["_kg_m3", "kg/m³"],
  ["_m3", "m³"],
  ["_m2", "m²"],
  ["_deg", "°"],
  ["_pa", "Pa"],
  ["_kg", "kg"],
  ["_nm", "N m"],
  ["_n", "N"],
  ["_s", "s"],
  ["_m", "m"],
];

const NAMES: Record<string, string> = {
  rest_x_m: "resting place downstream",
  rest_y_m: "resting place across",
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

/** Unit of the key of a quantity; empty without one. */
export function unitOf(key: string): string {
  return UNITS.find(([suffix]) => key.endsWith(suffix))?.[1] ?? "";
}

function withoutUnit(key: string): string {
  const suffix = UNITS.find(([suffix]) => key.endsWith(suffix))?.[0] ?? "";
  return key.slice(0, key.length - suffix.length).replaceAll("_", " ");
}

/** Name of a quantity, such as `peak speed`. */
export function nameOf(quantity: string): string {
  return NAMES[quantity] ?? withoutUnit(quantity);
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
    else words.push(withoutUnit(key));
  }
  return words.join(", ");
}

/** Last key of a pointer, whose name carries the unit. */
export function lastKey(pointer: string): string {
  return tokens(pointer).at(-1) ?? "";
}
