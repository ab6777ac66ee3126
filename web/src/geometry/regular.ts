/** The five regular solids, lying on a face as the solver lays them. */

import { facesOf } from "./polyhedron";
import { type Vector, cross, dot, minus, scaled, unit } from "./vectors";

const GOLDEN = (1 + Math.sqrt(5)) / 2;

/** Vertices of the regular solids about their centre, and the length of their edges. */
const REGULAR = new Map<string, [Vector[], number]>([
  ["tetrahedron", [signs([1, 1, 1]).filter(([x, y, z]) => x * y * z > 0), Math.sqrt(8)]],
  ["cube", [signs([1, 1, 1]), 2]],
  ["octahedron", [cyclic([0, 0, 1]), Math.sqrt(2)]],
  ["dodecahedron", [[...signs([1, 1, 1]), ...cyclic([0, 1 / GOLDEN, GOLDEN])], 2 / GOLDEN]],
  ["icosahedron", [cyclic([0, 1, GOLDEN]), 2]],
]);

function signs([x, y, z]: Vector): Vector[] {
  const both = (c: number) => (c === 0 ? [0] : [c, -c]);
  return both(x).flatMap((a) => both(y).flatMap((b) => both(z).map((c): Vector => [a, b, c])));
}

function cyclic([x, y, z]: Vector): Vector[] {
  return [...signs([x, y, z]), ...signs([y, z, x]), ...signs([z, x, y])];
}

/** A regular solid about its centre, for edges of length 1. */
export interface RegularSolid {
  vertices: Vector[];
  inradius: number;
}

/** Solids whose edge along y is the downstream one of the face they lie on, as the solver lays them;
 * that of the others is upstream. Tests hold this against the service. */
const DOWNSTREAM = new Set(["dodecahedron"]);

const lying = new Map<string, RegularSolid>();

/** Regular solid of this name that lies on a face, one edge of which runs along y. */
export function regularSolid(name: string): RegularSolid | undefined {
  const [standing, edge] = REGULAR.get(name) ?? [];
  if (!standing || !edge) return undefined;
  const known = lying.get(name);
  if (known) return known;
  const { normal, loop } = facesOf(standing)[0]!;
  const along = scaled(unit(minus(loop[1]!, loop[0]!)), DOWNSTREAM.has(name) ? -1 : 1);
  const up = scaled(normal, -1);
  const downstream = cross(along, up);
  const vertices = standing.map((v) => scaled([dot(downstream, v), dot(along, v), dot(up, v)], 1 / edge));
  const solid = { vertices, inradius: dot(normal, loop[0]!) / edge };
  lying.set(name, solid);
  return solid;
}
