/** Outlines of bodies in a view. */

import { type Quaternion, type Vector, turned } from "./vectors";

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

/** Outline from above of a core swept by a ball, turned and in its place [m]. */
export function outlineFromAbove(
  { core, radius }: { core: readonly Vector[]; radius: number },
  position: Vector,
  orientation: Quaternion,
): Place[] {
  const places = core.map((corner): Place => {
    const [x, y] = turned(orientation, corner);
    return [position[0] + x, position[1] + y];
  });
  return outlineOf(places, radius);
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
