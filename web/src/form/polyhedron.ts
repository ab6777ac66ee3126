/** Convex polyhedra: faces, centre of mass, and the five regular solids. */

import { type Vec3, add, cross, dot, length, minus, times, unit } from "./vectors";

/** A face of a convex hull. */
export interface Face {
  /** Unit normal, outwards. */
  normal: Vec3;
  /** Its vertices, counter-clockwise seen from outside. */
  loop: Vec3[];
}

/** Share of the size within which places lie in one plane, as in the solver. */
const FLAT = 1e-5;

/** Faces of the convex hull of at most a few dozen points; none if they enclose nothing. */
export function facesOf(points: Vec3[]): Face[] {
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
function outerNormal(a: Vec3, b: Vec3, c: Vec3, points: Vec3[], size: number): Vec3 | undefined {
  const normal = cross(minus(b, a), minus(c, a));
  if (length(normal) <= (FLAT * size) ** 2) return undefined;
  const [one, other] = [unit(normal), unit(times(-1, normal))];
  const isOuter = (n: Vec3) => points.every((point) => dot(n, minus(point, a)) <= FLAT * size);
  return isOuter(one) ? one : isOuter(other) ? other : undefined;
}

/** Points of a plane in order round their middle. */
function loopOf(points: Vec3[], normal: Vec3): Vec3[] {
  const middle = times(1 / points.length, points.reduce(add, [0, 0, 0]));
  const along = unit(minus(points.find((point) => length(minus(point, middle)) > 0) ?? points[0]!, middle));
  const across = cross(normal, along);
  const angle = (point: Vec3) => Math.atan2(dot(minus(point, middle), across), dot(minus(point, middle), along));
  return [...points].sort((a, b) => angle(a) - angle(b));
}

/** Centre of mass of the convex hull with these faces. */
export function centreOf(faces: Face[]): Vec3 {
  const origin = faces[0]?.loop[0] ?? [0, 0, 0];
  let volume = 0;
  let moment: Vec3 = [0, 0, 0];
  for (const { loop } of faces) {
    const [a, ...rest] = loop.map((point) => minus(point, origin));
    for (let i = 0; a && i + 1 < rest.length; i += 1) {
      const [b, c] = [rest[i]!, rest[i + 1]!];
      const sixth = dot(a, cross(b, c));
      volume += sixth;
      moment = add(moment, times(sixth / 4, add(a, add(b, c))));
    }
  }
  return volume > 0 ? add(origin, times(1 / volume, moment)) : origin;
}

const GOLDEN = (1 + Math.sqrt(5)) / 2;

/** Vertices of the regular solids about their centre, and the length of their edges. */
const REGULAR: Record<string, [Vec3[], number]> = {
  tetrahedron: [signs([1, 1, 1]).filter(([x, y, z]) => x * y * z > 0), Math.sqrt(8)],
  cube: [signs([1, 1, 1]), 2],
  octahedron: [cyclic([0, 0, 1]), Math.sqrt(2)],
  dodecahedron: [[...signs([1, 1, 1]), ...cyclic([0, 1 / GOLDEN, GOLDEN])], 2 / GOLDEN],
  icosahedron: [cyclic([0, 1, GOLDEN]), 2],
};

function signs([x, y, z]: Vec3): Vec3[] {
  const both = (c: number) => (c === 0 ? [0] : [c, -c]);
  return both(x).flatMap((a) => both(y).flatMap((b) => both(z).map((c): Vec3 => [a, b, c])));
}

function cyclic([x, y, z]: Vec3): Vec3[] {
  return [
    [x, y, z],
    [y, z, x],
    [z, x, y],
  ].flatMap((place) => signs(place as Vec3));
}

/** A regular solid about its centre, for edges of length 1. */
export interface RegularSolid {
  vertices: Vec3[];
  inradius: number;
}

/** Solids whose edge along y is the downstream one of the face they lie on, as the solver lays them;
 * that of the others is upstream. Tests hold this against the service. */
const DOWNSTREAM = new Set(["dodecahedron"]);

const lying = new Map<string, RegularSolid>();

/** Regular solid of this name that lies on a face, one edge of which runs along y. */
export function regularSolid(name: string): RegularSolid | undefined {
  const [standing, edge] = REGULAR[name] ?? [];
  if (!standing || !edge) return undefined;
  const known = lying.get(name);
  if (known) return known;
  const { normal, loop } = facesOf(standing)[0]!;
  const along = times(DOWNSTREAM.has(name) ? -1 : 1, unit(minus(loop[1]!, loop[0]!)));
  const up = times(-1, normal);
  const downstream = cross(along, up);
  const vertices = standing.map((v) => times(1 / edge, [dot(downstream, v), dot(along, v), dot(up, v)]));
  const solid = { vertices, inradius: dot(normal, loop[0]!) / edge };
  lying.set(name, solid);
  return solid;
}
