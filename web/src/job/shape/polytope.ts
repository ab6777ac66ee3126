/** Convex polyhedra by their planes: hull of points, erosion, corners and faces. */

import { type Vector, cross, dot, length, minus, plus, scaled, unit } from "./vector";

/** The half space n · x ≤ d. */
export interface Plane {
  normal: Vector;
  offset: number;
}

/** A convex polyhedron: corners, and each face's loop of them, anticlockwise from outside. */
export interface Polytope {
  corners: Vector[];
  faces: { normal: Vector; loop: number[] }[];
}

/** Size below which features are one, over the size of the whole. */
const SAME = 1e-5;

/** Planes of the convex hull of a few points: of all planes through three those with all on one side. */
export function hullPlanes(points: readonly Vector[]): Plane[] {
  const planes: Plane[] = [];
  const near = SAME * sizeOf(points);
  for (const [i, a] of points.entries()) {
    for (let j = i + 1; j < points.length; j += 1) {
      for (let k = j + 1; k < points.length; k += 1) {
        const normal = cross(minus(points[j] ?? a, a), minus(points[k] ?? a, a));
        if (length(normal) > near * near) add(planes, points, unit(normal), dot(unit(normal), a), near);
      }
    }
  }
  return planes;
}

function add(planes: Plane[], points: readonly Vector[], normal: Vector, offset: number, near: number): void {
  const heights = points.map((point) => dot(normal, point) - offset);
  const isUpper = heights.every((height) => height <= near);
  if (!isUpper && !heights.every((height) => height >= -near)) return;
  const plane = isUpper ? { normal, offset } : { normal: scaled(normal, -1), offset: -offset };
  if (!planes.some((other) => dot(other.normal, plane.normal) > 1 - 1e-8)) planes.push(plane);
}

function sizeOf(points: readonly Vector[]): number {
  const first = points[0] ?? [0, 0, 0];
  return Math.max(...points.map((point) => length(minus(point, first))), 1e-12);
}

/** Planes moved inwards by a distance. */
export function eroded(planes: readonly Plane[], by: number): Plane[] {
  return planes.map(({ normal, offset }) => ({ normal, offset: offset - by }));
}

/** The polyhedron within all planes. */
export function within(planes: readonly Plane[]): Polytope {
  const corners = cornersOf(planes);
  const near = 1e-6 * sizeOf(corners);
  const faces = planes.map(({ normal, offset }) => {
    const on = [...corners.keys()].filter(
      (place) => Math.abs(dot(normal, corners[place] ?? normal) - offset) < 10 * near,
    );
    return { normal, loop: aroundNormal(corners, on, normal) };
  });
  return { corners, faces: faces.filter(({ loop }) => loop.length >= 3) };
}

function cornersOf(planes: readonly Plane[]): Vector[] {
  const corners: Vector[] = [];
  const size = Math.max(...planes.map(({ offset }) => Math.abs(offset)), 1e-12);
  for (const [i, a] of planes.entries()) {
    for (const [j, b] of planes.entries()) {
      if (j <= i) continue;
      const along = cross(a.normal, b.normal);
      if (length(along) < 1e-9) continue;
      for (let k = j + 1; k < planes.length; k += 1) {
        const corner = meeting(a, b, planes[k] ?? a, along);
        if (!corner || planes.some(({ normal, offset }) => dot(normal, corner) > offset + 1e-7 * size)) continue;
        if (!corners.some((other) => length(minus(other, corner)) < 1e-6 * size)) corners.push(corner);
      }
    }
  }
  return corners;
}

/** Where three planes meet, by Cramer's rule. */
function meeting(a: Plane, b: Plane, c: Plane, along: Vector): Vector | undefined {
  const determinant = dot(along, c.normal);
  if (Math.abs(determinant) < 1e-9) return undefined;
  const sum = plus(scaled(cross(b.normal, c.normal), a.offset), cross(c.normal, a.normal), b.offset);
  return scaled(plus(sum, along, c.offset), 1 / determinant);
}

/** Corners of a face in the order of their angle about its normal. */
function aroundNormal(corners: readonly Vector[], on: number[], normal: Vector): number[] {
  const places = on.map((place) => corners[place] ?? normal);
  const centre = scaled(
    places.reduce((sum, place) => plus(sum, place), [0, 0, 0] as Vector),
    1 / (places.length || 1),
  );
  const first = unit(minus(places[0] ?? normal, centre));
  const second = cross(normal, first);
  const angle = (place: number) => {
    const arm = minus(corners[place] ?? centre, centre);
    return Math.atan2(dot(arm, second), dot(arm, first));
  };
  return [...on].sort((a, b) => angle(a) - angle(b));
}
