/** Quantities of an outcome, each with its uncertainty interval where there is one. */

import type { Outcome, Schemas } from "../../api/client";
import { figure } from "../../parts/format";
import type { Ground } from "../../scenario/ground";

export type Interval = Schemas["UncertaintyInterval"];

/** A quantity of an outcome. */
export interface Quantity {
  key: string;
  name: string;
  unit: string;
  value: number | null;
  /** Significant digits with which it is shown. */
  digits: number;
  interval: Interval | undefined;
}

type BodyKey =
  | "first_contact_time_s"
  | "onset_time_s"
  | "peak_speed_m_s"
  | "peak_speed_time_s"
  | "stop_time_s"
  | "displacement_m"
  | "path_length_m"
  | "burial_depth_m";

const BODY: [BodyKey, string, string][] = [
  ["first_contact_time_s", "First contact", "s"],
  ["onset_time_s", "Onset of motion", "s"],
  ["peak_speed_m_s", "Peak speed", "m/s"],
  ["peak_speed_time_s", "Time of peak speed", "s"],
  ["stop_time_s", "At rest from", "s"],
  ["displacement_m", "Displacement", "m"],
  ["path_length_m", "Path length", "m"],
  ["burial_depth_m", "Burial depth", "m"],
];

/** Significant digits of most quantities, and of places on a terrain, which lie far from its corner. */
const DIGITS = 4;
const DIGITS_OF_PLACES: Record<Ground, number> = { channel: DIGITS, terrain: 6 };

/** Names of the components of a place. */
const AXES: Record<Ground, string[]> = {
  channel: ["Final position x", "Final position y", "Final position z"],
  terrain: ["Final position, east", "Final position, north", "Final position, up"],
};

/** Name of the flow's farthest distance. */
const FRONT: Record<Ground, string> = { channel: "Front", terrain: "Front, from the middle of the release" };

const FLOW: ["front_m" | "runout_m" | "outflow_mass_kg" | "excluded_volume_m3", string, string][] = [
  ["front_m", "Front", "m"],
  ["runout_m", "Run-out", "m"],
  ["outflow_mass_kg", "Outflow", "kg"],
  ["excluded_volume_m3", "Volume not placed", "m³"],
];

/** Quantities of a body, the components of its final position among them. */
export function bodyQuantities(body: Schemas["BodyOutcome"], ground: Ground): Quantity[] {
  const bars = (body.error_bars ?? {}) as Partial<Record<string, Interval>>;
  const scalars = BODY.map(([key, name, unit]) => ({
    key,
    name,
    unit,
    value: body[key] ?? null,
    digits: DIGITS,
    interval: bars[key],
  }));
  const places = AXES[ground].map((name, k) => ({
    key: `final_position_m/${k}`,
    name,
    unit: "m",
    value: body.final_position_m[k] ?? null,
    digits: DIGITS_OF_PLACES[ground],
    interval: body.error_bars?.final_position_m[k],
  }));
  return [...scalars, ...places];
}

/** Quantities of the flow; of one whose front has left the map, what it has all the same. */
export function flowQuantities(outcome: Outcome, ground: Ground): Quantity[] {
  const { front_m: front, outflow_mass_kg: outflow } = outcome.flow;
  if (front === null && outflow === 0) return [];
  const bars = (outcome.flow.error_bars ?? {}) as Partial<Record<string, Interval>>;
  return FLOW.map(([key, name, unit]) => ({
    key,
    name: key === "front_m" ? FRONT[ground] : name,
    unit,
    value: outcome.flow[key] ?? null,
    digits: DIGITS,
    interval: bars[key],
  })).filter(({ value }) => value !== null);
}

/** An interval in words: both ends, or which is open. */
export function intervalText(interval: Interval | undefined, digits: number): string {
  if (!interval) return "";
  const { low, high } = interval;
  if (low === null && high === null) return "none";
  if (high === null) return `from ${figure(low, digits)}`;
  if (low === null) return `up to ${figure(high, digits)}`;
  return `${figure(low, digits)} to ${figure(high, digits)}`;
}

/** What the kind of an interval says. */
export const BASIS: Record<Schemas["Basis"], string> = {
  converging: "the runs' values go one way",
  scattered: "the runs' values scatter",
  same: "all runs gave the same value",
  one_refinement_run: "one refinement run alone",
  sometimes_happened: "some runs did not have it",
  never_happened: "no run had it",
  nothing: "no refinement run succeeded",
};

/** Whether two intervals overlap; undefined where either is not closed. */
export function overlap(a: Interval | undefined, b: Interval | undefined): boolean | undefined {
  if (!a || !b || a.low === null || a.high === null || b.low === null || b.high === null) return undefined;
  return a.low <= b.high && b.low <= a.high;
}
