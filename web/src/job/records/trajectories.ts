/** Trajectories of bodies: values and poses at any time. */

import type { Job, Trajectory } from "../../api/client";
import type { Quaternion, Vector } from "../../geometry/vectors";

/** Motion of a body: a pose at each sample. */
export interface Poses {
  body: number;
  time: number[];
  position: Vector[];
  orientation: Quaternion[];
  /** Share of the body's height below the surface of the flow at the last sample, 0..1. */
  lastSubmergence: number;
}

/** Quantities of a body against time, for curves. */
export interface Curves {
  body: number;
  time: number[];
  displacement: number[];
  speed: number[];
  submergence: number[];
  flowForce: number[];
  contactForce: number[];
}

/** Columns of a trajectory as the service tells them. */
export type Columns = Trajectory["columns"];

/** One sample in how many is read, so that at most `most` of a run of this length come. */
export function strideFor(simulated: number, interval: number, most: number): number {
  return Math.max(1, Math.ceil((simulated / interval + 2) / Math.max(1, most)));
}

/** Simulated time that a job has records of [s]. */
export function recordedTime(job: Job): number {
  return job.status === "successful"
    ? (job.outcome?.ended_early?.time_s ?? job.progress.simulated_time_s)
    : job.progress.simulated_time_s;
}

/** Columns with later ones behind them. */
export function appended(columns: Columns, later: Columns): Columns {
  const fields = Object.keys({ ...columns, ...later }) as (keyof Columns)[];
  return Object.fromEntries(fields.map((field) => [field, [...(columns[field] ?? []), ...(later[field] ?? [])]]));
}

/** Poses from the columns of a trajectory. */
export function posesOf(
  body: number,
  { time_s = [], position_m = [], orientation = [], submerged_fraction = [] }: Columns,
): Poses {
  const lastSubmergence = submerged_fraction[submerged_fraction.length - 1] ?? 0;
  return {
    body,
    time: time_s,
    position: position_m as unknown as Vector[],
    orientation: orientation as unknown as Quaternion[],
    lastSubmergence,
  };
}

/** Curves from the columns of a trajectory. */
export function curvesOf(body: number, columns: Columns): Curves {
  const norm = (v: number[] | undefined) => Math.hypot(...(v ?? [0]));
  const position = columns.position_m ?? [];
  const [x0 = 0, y0 = 0] = position[0] ?? [];
  const walls = columns.wall_force_n ?? [];
  return {
    body,
    time: columns.time_s ?? [],
    displacement: position.map(([x = 0, y = 0]) => Math.hypot(x - x0, y - y0)),
    speed: (columns.velocity_m_s ?? []).map(norm),
    submergence: (columns.submerged_fraction ?? []).map((share) => 100 * share),
    flowForce: (columns.flow_force_n ?? []).map(norm),
    contactForce: walls.map((force, place) =>
      norm(force.map((value, axis) => value + (columns.body_force_n?.[place]?.[axis] ?? 0))),
    ),
  };
}

/** Index of the last sample that is not after a time. */
export function sampleAt(times: ArrayLike<number>, time: number): number {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((times[middle] ?? 0) <= time) low = middle + 1;
    else high = middle;
  }
  return Math.max(0, low - 1);
}

/** A value at a time, linear between samples. */
export function valueAt(times: ArrayLike<number>, values: ArrayLike<number>, time: number): number | undefined {
  const place = sampleAt(times, time);
  const [a, b] = [values[place], values[place + 1]];
  if (a === undefined || b === undefined) return a;
  const span = (times[place + 1] ?? 0) - (times[place] ?? 0);
  return a + (b - a) * Math.min(1, Math.max(0, span > 0 ? (time - (times[place] ?? 0)) / span : 0));
}

/** Place and orientation at a time: linear, and along the shorter great arc. */
export function poseAt(
  { time: times, position, orientation }: Poses,
  time: number,
): { position: Vector; orientation: Quaternion } | undefined {
  const place = sampleAt(times, time);
  const [p, q] = [position[place], orientation[place]];
  if (!p || !q) return undefined;
  const [p1, q1] = [position[place + 1] ?? p, orientation[place + 1] ?? q];
  const span = (times[place + 1] ?? 0) - (times[place] ?? 0);
  const share = span > 0 ? Math.min(1, Math.max(0, (time - (times[place] ?? 0)) / span)) : 0;
  const mixed = (axis: 0 | 1 | 2) => p[axis] + (p1[axis] - p[axis]) * share;
  return { position: [mixed(0), mixed(1), mixed(2)], orientation: between(q, q1, share) };
}

function between(a: Quaternion, b: Quaternion, share: number): Quaternion {
  const cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const angle = Math.acos(Math.min(1, Math.abs(cosine)));
  const sine = Math.sin(angle);
  const [s, t] =
    sine < 1e-6 ? [1 - share, share] : [Math.sin((1 - share) * angle) / sine, Math.sin(share * angle) / sine];
  const sign = cosine < 0 ? -1 : 1;
  const mixed = (k: 0 | 1 | 2 | 3) => s * a[k] + sign * t * b[k];
  return [mixed(0), mixed(1), mixed(2), mixed(3)];
}
