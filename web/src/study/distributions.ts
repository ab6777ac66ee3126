/** Distributions of inputs as sentences, and their densities as curves. */

import { figure } from "../parts/format";
import type { Distribution } from "./documents";

/** A point of a density, or a bar of a discrete distribution: a value and its relative height. */
export interface Height {
  x: number;
  y: number;
}

/** Picture of a distribution: a density, or the bars of single values. */
export interface Shape {
  kind: "density" | "bars";
  heights: Height[];
}

/** Number of the points of a density. */
const POINTS = 81;
/** Standard normal quantile at 95 %. */
const Z95 = 1.6448536269514722;
/** Standard deviations up to which a normal density is drawn. */
const REACH = 3;
/** Values that a sentence names one by one. */
const MOST_NAMED = 5;

/** Sentence that describes a distribution, with its unit. */
export function sentence(distribution: Distribution | null | undefined, unit: string): string {
  if (!distribution) return "Values as the design gives them.";
  const of = (value: number) => (unit === "" ? figure(value, 4) : `${figure(value, 4)} ${unit}`);
  if ("uniform" in distribution) {
    const { from, to } = distribution.uniform;
    return `Between ${of(from)} and ${of(to)}, each value as likely.`;
  }
  if ("triangular" in distribution) {
    const { from, mode, to } = distribution.triangular;
    return `Between ${of(from)} and ${of(to)}, most likely ${of(mode)}.`;
  }
  if ("lognormal" in distribution) {
    const { median, p95 } = distribution.lognormal;
    return `Lognormal with median ${of(median)}; 19 of 20 draws are below ${of(p95)}.`;
  }
  if ("normal" in distribution) {
    const { mean, sd, truncate } = distribution.normal;
    const range = truncate ? `, within ${of(truncate.from)} and ${of(truncate.to)}` : "";
    return `Normal with mean ${of(mean)} and standard deviation ${of(sd)}${range}.`;
  }
  if ("list" in distribution) return listed(distribution.list.values, of);
  return chosen(distribution.choice.values, of);
}

function listed(values: number[], of: (value: number) => string): string {
  if (values.length <= MOST_NAMED) return `One of ${values.map(of).join(", ")}, each as likely.`;
  return `One of ${values.length} numbers from ${of(Math.min(...values))} to ${of(Math.max(...values))}, each as likely.`;
}

function chosen(values: { value?: unknown; weight: number }[], of: (value: number) => string): string {
  const all = values.reduce((sum, { weight }) => sum + weight, 0);
  const named = values.slice(0, MOST_NAMED).map(({ value, weight }) => {
    const text = typeof value === "number" ? of(value) : JSON.stringify(value);
    return `${text} (${figure((100 * weight) / all, 3)} %)`;
  });
  const more = values.length - named.length;
  return `One of ${named.join(", ")}${more > 0 ? ` and ${more} more` : ""}.`;
}

/** Shape of a distribution; none of values that are no numbers. */
export function shape(distribution: Distribution | null | undefined): Shape | undefined {
  if (!distribution) return undefined;
  if ("list" in distribution) return bars(distribution.list.values.map((value) => ({ value, weight: 1 })));
  if ("choice" in distribution) return bars(distribution.choice.values);
  if ("uniform" in distribution) {
    const { from, to } = distribution.uniform;
    return { kind: "density", heights: [from, to].map((x) => ({ x, y: 1 })) };
  }
  if ("triangular" in distribution) {
    const { from, mode, to } = distribution.triangular;
    return { kind: "density", heights: [from, mode, to].map((x) => ({ x, y: x === mode ? 1 : 0 })) };
  }
  if ("lognormal" in distribution) {
    const { median, p95 } = distribution.lognormal;
    const sigma = Math.log(p95 / median) / Z95;
    const ends = [-REACH, 0.85 * REACH].map((z) => median * Math.exp(z * sigma));
    return density(ends, (x) => Math.exp(-0.5 * (Math.log(x / median) / sigma) ** 2) / x);
  }
  const { mean, sd, truncate } = distribution.normal;
  const from = Math.max(mean - REACH * sd, truncate?.from ?? -Infinity);
  const to = Math.min(mean + REACH * sd, truncate?.to ?? Infinity);
  return density([from, to], (x) => Math.exp(-0.5 * ((x - mean) / sd) ** 2));
}

function density([from = 0, to = 1]: number[], at: (x: number) => number): Shape {
  const heights = Array.from({ length: POINTS }, (_, place) => {
    const x = from + (to - from) * (place / (POINTS - 1));
    return { x, y: at(x) };
  });
  const most = Math.max(...heights.map(({ y }) => y));
  return { kind: "density", heights: heights.map(({ x, y }) => ({ x, y: y / most })) };
}

function bars(values: { value?: unknown; weight: number }[]): Shape | undefined {
  const heights = values.flatMap(({ value, weight }) => (typeof value === "number" ? [{ x: value, y: weight }] : []));
  if (heights.length < values.length) return undefined;
  const most = Math.max(...heights.map(({ y }) => y));
  return { kind: "bars", heights: heights.map(({ x, y }) => ({ x, y: y / most })) };
}
