/** Outlines of bodies in a view, and the marks of its axes. */

/** A place in a view [m]. */
export type Place = [number, number];

/** Number of places on a full circle. */
const CIRCLE = 24;

/** Outline of the core's places, swept by a disc. */
export function outlineOf(core: Place[], radius: number): Place[] {
  const hull = convexHull(core);
  if (radius <= 0) return hull;
  const swept = hull.flatMap(([x, y]) =>
    Array.from({ length: CIRCLE }, (_, index): Place => {
      const angle = (2 * Math.PI * index) / CIRCLE;
      return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
    }),
  );
  return convexHull(swept);
}

/** Convex hull, counter-clockwise (Andrew's monotone chain). */
export function convexHull(places: Place[]): Place[] {
  const sorted = [...places].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  if (sorted.length < 3) return sorted;
  const lower = chain(sorted);
  const upper = chain(sorted.reverse());
  return [...lower.slice(0, -1), ...upper.slice(0, -1)];
}

function chain(sorted: Place[]): Place[] {
  const kept: Place[] = [];
  for (const place of sorted) {
    while (kept.length > 1 && turn(kept.at(-2)!, kept.at(-1)!, place) <= 0) kept.pop();
    kept.push(place);
  }
  return kept;
}

function turn(a: Place, b: Place, c: Place): number {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

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

/** Marks of an axis between two values: about `count` of them. */
export function marks(low: number, high: number, count: number): number[] {
  const step = roundBelow((high - low) / Math.max(1, count)) || 1;
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, index) => snapped((first + index) * step, step));
}
