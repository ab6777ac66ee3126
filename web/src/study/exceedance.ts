/** Exceedance curve: the share of the members whose quantity is larger than a threshold. */

import { lowerBound, upperBound } from "./binomial";

/** A step of the curve: what holds from a threshold to that of the next step. */
export interface Step {
  threshold: number;
  estimate: number;
  lower: number;
  upper: number;
}

/** Most steps that a picture tells apart. */
const MOST_STEPS = 400;

/** Steps of the curve of these values, with bounds in which members of unknown value could have
 * come out in any way. The first step begins at minus infinity in truth; here at the first value. */
export function curve(values: number[], unknown: number): Step[] {
  const sorted = [...values].sort((a, b) => a - b);
  const known = sorted.length;
  const every = Math.max(1, Math.ceil(known / MOST_STEPS));
  const steps: Step[] = [];
  for (let below = 0; below <= known; below += 1) {
    const isLast = below === known;
    const threshold = sorted[Math.max(0, below - 1)] ?? 0;
    // Equal values are one step, that of the last of them.
    if (!isLast && (sorted[below] === sorted[below - 1] || below % every !== 0)) continue;
    steps.push({ threshold, ...at(known - below, known, unknown) });
  }
  return known === 0 ? [] : steps;
}

/** Probability of a value above a threshold, with its bounds. */
export function exceeding(values: number[], unknown: number, threshold: number): Step {
  const above = values.filter((value) => value > threshold).length;
  return { threshold, ...at(above, values.length, unknown) };
}

function at(above: number, known: number, unknown: number): Omit<Step, "threshold"> {
  const all = known + unknown;
  return {
    estimate: known === 0 ? Number.NaN : above / known,
    lower: lowerBound(above, all),
    upper: upperBound(above + unknown, all),
  };
}
