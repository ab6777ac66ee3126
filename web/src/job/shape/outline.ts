/** Outlines of bodies as seen from above. */

import type { Surface } from "./surface";
import { type Quaternion, type Vector, turned } from "./vector";

const CIRCLE_POINTS = 24;

/** Outline of a body seen from above [m], anticlockwise: the hull of its turned core, widened by its radius. */
export function outlineFromAbove(
  { core, radius }: Surface,
  position: Vector,
  orientation: Quaternion,
): [number, number][] {
  const points = core.flatMap((corner) => {
    const [x, y] = turned(orientation, corner);
    return Array.from({ length: CIRCLE_POINTS }, (_, step): [number, number] => {
      const angle = (2 * Math.PI * step) / CIRCLE_POINTS;
      return [position[0] + x + radius * Math.cos(angle), position[1] + y + radius * Math.sin(angle)];
    });
  });
  return hull(points);
}

/** Convex hull by Andrew's monotone chain. */
function hull(points: [number, number][]): [number, number][] {
  points.sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  return [...half(points), ...half(points.reverse())];
}

function half(points: [number, number][]): [number, number][] {
  const chain: [number, number][] = [];
  for (const point of points) {
    for (;;) {
      const [a, b] = chain.slice(-2);
      if (!a || !b || (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]) > 0) break;
      chain.pop();
    }
    chain.push(point);
  }
  chain.pop();
  return chain;
}
