/** Scales of pictures: ranges, round values, and maps with equal scales along both axes. */

import { multiples, niceStep } from "../parts/round-values";
import type { Place } from "./documents";

export type Range = [from: number, to: number];

/** Range of values with a margin of this share of its length; a unit around a single value. */
export function rangeOf(values: number[], margin: number): Range {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (!Number.isFinite(low)) return [0, 1];
  if (high - low < 1e-9 + 1e-6 * Math.max(Math.abs(low), Math.abs(high))) return [low - 0.5, high + 0.5];
  const beyond = margin * (high - low);
  return [low - beyond, high + beyond];
}

/** Round values in a range: at most about so many. */
export function roundValues([from, to]: Range, count: number): number[] {
  return multiples(niceStep(to - from, Math.max(1, count)), from, to);
}

/** Ranges of a map on equal scales, and its height [px]. */
export interface MapScale {
  x: Range;
  y: Range;
  width: number;
  height: number;
}

/** Least and largest height of a map [px]. */
const HEIGHTS: Range = [130, 560];

/** Scale of a map that shows these ranges; one of them gets wider if need be. */
export function mapScale(x: Range, y: Range, width: number): MapScale {
  const [length, across] = [x[1] - x[0], y[1] - y[0]];
  const height = Math.min(Math.max((width * across) / length, HEIGHTS[0]), HEIGHTS[1]);
  const scale = Math.max(length / width, across / height);
  return { x: widened(x, scale * width), y: widened(y, scale * height), width, height };
}

function widened([from, to]: Range, length: number): Range {
  const by = Math.max(0, 0.5 * (length - (to - from)));
  return [from - by, to + by];
}

/** Place on a map [px]; across grows upwards. */
export function onMap({ x, y, width, height }: MapScale, [downstream, across]: Place): Place {
  return [((downstream - x[0]) / (x[1] - x[0])) * width, (1 - (across - y[0]) / (y[1] - y[0])) * height];
}
