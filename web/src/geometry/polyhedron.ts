/** Convex polyhedra from their corners: faces and centre of mass. */

import { type Vector, cross, dot, length, minus, plus, scaled, total, unit } from "./vectors";

/** A face of a convex hull. */
export interface Face {
  /** Unit normal, outwards. */
  normal: Vector;
  /** Its vertices, counter-clockwise seen from outside. */
  loop: Vector[];
}

/** Share of the size within which places lie in one plane, as in the solver. */
const FLAT = 1e-5;

/** Faces of the convex hull of at most a few dozen points; none if they enclose nothing. */
export function facesOf(points: readonly Vector[]): Face[] {
  const size = Math.max(...points.map((point) => length(minus(point, points[0] ?? point))));
  const faces: Face[] = [];
  points.forEach((a, i) =>
    points.slice(i + 1).forEach((b, j) =>
      points.slice(i + j + 2).forEach((c) => {
        const normal = outerNormal(a, b, c, points, size);
        if (normal && !faces.some((face) => dot(face.normal, normal) > 1 - FLAT ** 2)) {
          const inPlane = points.filter((point) => Math.abs(dot(normal, minus(point, a))) <= FLAT * size);
          faces.push({ normal, loop: loopOf(inPlane, normal) });
        }
      }),
    ),
  );
  return faces.length >= 4 ? faces : [];
}

/** Normal of the plane of three points if all points lie on or behind it. */
function outerNormal(a: Vector, b: Vector, c: Vector, points: readonly Vector[], size: number): Vector | undefined {
  const normal = cross(minus(b, a), minus(c, a));
  if (length(normal) <= (FLAT * size) ** 2) return undefined;
  const [one, other] = [unit(normal), unit(scaled(normal, -1))];
  const isOuter = (n: Vector) => points.every((point) => dot(n, minus(point, a)) <= FLAT * size);
  return isOuter(one) ? one : isOuter(other) ? other : undefined;
}

/** Points of a plane in order round their middle. */
function loopOf(points: readonly Vector[], normal: Vector): Vector[] {
  const middle = scaled(total(points), 1 / points.length);
  const along = unit(minus(points.find((point) => length(minus(point, middle)) > 0) ?? points[0]!, middle));
  const across = cross(normal, along);
  const angle = (point: Vector) => Math.atan2(dot(minus(point, middle), across), dot(minus(point, middle), along));
  return [...points].sort((a, b) => angle(a) - angle(b));
}

/** Centre of mass of the convex hull with these faces. */
export function centreOf(faces: Face[]): Vector {
  const origin = faces[0]?.loop[0] ?? [0, 0, 0];
  let volume = 0;
  let moment: Vector = [0, 0, 0];
  for (const { loop } of faces) {
    const [a, ...rest] = loop.map((point) => minus(point, origin));
    for (let i = 0; a && i + 1 < rest.length; i += 1) {
      const [b, c] = [rest[i]!, rest[i + 1]!];
      const sixth = dot(a, cross(b, c));
      volume += sixth;
      moment = plus(moment, total([a, b, c]), sixth / 4);
    }
  }
  return volume > 0 ? plus(origin, moment, 1 / volume) : origin;
}
