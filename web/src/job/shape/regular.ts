/** The five regular solids, lying on a face as scenarios mean them. */

import { hullPlanes } from "./polytope";
import { type Vector, cross, dot, length, minus, plus, scaled, unit } from "./vector";

const GOLDEN = (1 + Math.sqrt(5)) / 2;

const cube = signs([1, 1, 1]);

/** Corners about the centre, and the length of their edges. */
const SOLIDS: Record<string, { corners: Vector[]; edge: number }> = {
  tetrahedron: { corners: cube.filter(([x, y, z]) => x * y * z > 0), edge: Math.sqrt(8) },
  cube: { corners: cube, edge: 2 },
  octahedron: { corners: cyclic([0, 0, 1]), edge: Math.SQRT2 },
  dodecahedron: { corners: [...cube, ...cyclic([0, 1 / GOLDEN, GOLDEN])], edge: 2 / GOLDEN },
  icosahedron: { corners: cyclic([0, 1, GOLDEN]), edge: 2 },
};

/** Corners of a solid [m] whose lowest face is normal to z, with an edge along y on its upstream side. */
export function regularCorners(solid: string, size: number): Vector[] {
  const { corners, edge } = SOLIDS[solid] ?? { corners: cube, edge: 2 };
  const plane = hullPlanes(corners)[0] ?? { normal: [0, 0, -1] as Vector, offset: 1 };
  const on = corners.filter((corner) => Math.abs(dot(corner, plane.normal) - plane.offset) < 1e-6);
  const [one = [1, 0, 0]] = on;
  const next = on.find((other) => Math.abs(length(minus(other, one)) - edge) < 1e-6) ?? one;
  const upstream = unit(minus(scaled(plus(one, next), 0.5), scaled(plane.normal, plane.offset)));
  const [x, z] = [scaled(upstream, -1), scaled(plane.normal, -1)];
  const y = cross(z, x);
  return corners.map((corner) => scaled([dot(corner, x), dot(corner, y), dot(corner, z)], size / edge));
}

function signs([x, y, z]: Vector): Vector[] {
  const both = (value: number) => (value === 0 ? [0] : [value, -value]);
  return both(x).flatMap((x) => both(y).flatMap((y) => both(z).map((z): Vector => [x, y, z])));
}

function cyclic([x, y, z]: Vector): Vector[] {
  return [...signs([x, y, z]), ...signs([y, z, x]), ...signs([z, x, y])];
}
