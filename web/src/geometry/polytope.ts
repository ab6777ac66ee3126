/** Convex polyhedra by their planes: erosion, corners and faces. */

import { facesOf } from "./polyhedron";
import { type Vector, cross, dot, length, minus, plus, scaled, total, unit } from "./vectors";

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

/** Planes of the faces of the convex hull of a few points. */
export function hullPlanes(points: readonly Vector[]): Plane[] {
  return facesOf(points).map(({ normal, loop }) => ({ normal, offset: dot(normal, loop[0] ?? normal) }));
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
  const centre = scaled(total(places), 1 / (places.length || 1));
  const first = unit(minus(places[0] ?? normal, centre));
  const second = cross(normal, first);
  const angle = (place: number) => {
    const arm = minus(corners[place] ?? centre, centre);
    return Math.atan2(dot(arm, second), dot(arm, first));
  };
  return [...on].sort((a, b) => angle(a) - angle(b));
}
