/** What the plots of a job show: curves of its bodies, and events on them. */

import type { Outcome } from "../../api/client";
import { bodyColour } from "../colours";
import { type Curves, valueAt } from "../records/trajectories";
import type { Curve, Mark } from "./plot";
import type { PlotSpec } from "./plots";

type CurveKey = "displacement" | "speed" | "submergence" | "flowForce" | "contactForce";

/** Quantities that are plotted. */
export const PLOTTED: { key: CurveKey; name: string; unit: string; isMarked: boolean }[] = [
  { key: "displacement", name: "Displacement", unit: "m", isMarked: true },
  { key: "speed", name: "Speed", unit: "m/s", isMarked: true },
  { key: "submergence", name: "Submergence, share of the height", unit: "%", isMarked: false },
  { key: "flowForce", name: "Force of the flow on the body", unit: "N", isMarked: false },
  { key: "contactForce", name: "Force of walls, ground and other bodies", unit: "N", isMarked: false },
];

/** A job's part in the plots. */
export interface PlottedJob {
  curves: Curves[];
  outcome: Outcome | null | undefined;
  /** Put before the name of each body, where there are several jobs. */
  prefix?: string;
  dash?: number[];
}

/** All plots of some jobs together. */
export function plotsOf(jobs: PlottedJob[], isDark: boolean): PlotSpec[] {
  return PLOTTED.map(({ key, name, unit, isMarked }) => ({
    name,
    unit,
    curves: jobs.flatMap((job) => job.curves.map((curves) => curveOf(job, curves, key, isDark))),
    marks: isMarked ? jobs.flatMap((job) => job.curves.flatMap((curves) => marksOf(job, curves, key, isDark))) : [],
  }));
}

function curveOf({ prefix = "", dash }: PlottedJob, curves: Curves, key: CurveKey, isDark: boolean): Curve {
  // Colours begin again after six bodies.
  const pattern = dash ?? (Math.floor(curves.body / 6) % 2 === 1 ? [2, 4] : undefined);
  return {
    name: `${prefix}Body ${curves.body}`,
    colour: bodyColour(curves.body, isDark),
    time: curves.time,
    values: curves[key],
    ...(pattern ? { dash: pattern } : {}),
  };
}

function marksOf({ outcome }: PlottedJob, curves: Curves, key: CurveKey, isDark: boolean): Mark[] {
  const body = outcome?.bodies[curves.body];
  if (!body) return [];
  const colour = bodyColour(curves.body, isDark);
  const events: [Mark["kind"], number | null][] = [
    ["onset", body.onset_time_s],
    ["peak", body.peak_speed_time_s],
    ["rest", body.stop_time_s],
  ];
  return events.flatMap(([kind, time]) => {
    const value = time === null ? undefined : valueAt(curves.time, curves[key], time);
    return time === null || value === undefined ? [] : [{ kind, colour, time, value }];
  });
}
