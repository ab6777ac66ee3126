/** Round values for steps and axes: 1, 2 or 5 times a power of ten, and their multiples. */

/** Largest of 1, 2, 5 times a power of ten that is not above the value. */
export function roundBelow(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const factor = [5, 2, 1].find((factor) => factor * power <= value * (1 + 1e-9)) ?? 1;
  return factor * power;
}

/** The value on the nearest multiple of a step, without digits that come of rounding. */
export function snapped(value: number, step: number): number {
  const digits = Math.max(0, -Math.floor(Math.log10(step)));
  return Number((Math.round(value / step) * step).toFixed(digits));
}

/** Multiples of a round step between two values: at least about so many. */
export function marks(low: number, high: number, count: number): number[] {
  return multiples(roundBelow((high - low) / Math.max(1, count)) || 1, low, high);
}

/** Distance of grid lines: at most about so many on a length. */
export function niceStep(length: number, about: number): number {
  const rough = length / about;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].find((step) => step * power >= rough * 0.999) ?? 10;
  return Number((step * power).toPrecision(1));
}

/** Multiples of a step within a range. */
export function multiples(step: number, from: number, to: number): number[] {
  const first = Math.ceil(from / step - 1e-9);
  const count = Math.floor(to / step + 1e-9) - first + 1;
  return Array.from({ length: Math.max(0, count) }, (_, k) => Number(((first + k) * step).toPrecision(12)));
}
