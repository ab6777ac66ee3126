/** Surfaces of bodies: of a convex core, swept by a sphere. */

import { type Polytope, eroded, hullPlanes, within } from "./polytope";
import { regularSolid } from "./regular";
import { type Vector, cross, dot, minus, plus, scaled, slerp, total, unit } from "./vectors";

/** Shape of a body as a scenario has it. */
export interface BodyShape {
  shape: object;
  sphero_radius_m?: number;
}

/** Triangles with a normal at each corner, about the centre of mass, in body axes [m]. */
export interface Surface {
  positions: number[];
  normals: number[];
  triangles: number[];
  /** Corners of the core, about the centre of mass [m]. */
  core: Vector[];
  radius: number;
  volume: number;
}

const known = new Map<string, Surface>();

/** Surface of a body, computed once for each shape. */
export function surfaceOf({ shape, sphero_radius_m: radius = 0 }: BodyShape, steps = 4): Surface {
  const key = JSON.stringify([shape, radius, steps]);
  let surface = known.get(key);
  if (!surface) known.set(key, (surface = centred(made(shape as AnyShape, radius, steps))));
  return surface;
}

interface AnyShape {
  cube?: { side_m: number };
  box?: { sides_m: number[] };
  regular?: { solid: string; size_m: number };
  polyhedron?: { vertices_m: number[][] };
  ball?: { radius_m: number };
  capsule?: { radius_m: number; length_m: number };
}

function made({ cube, box, regular, polyhedron, ball, capsule }: AnyShape, radius: number, steps: number): Surface {
  if (ball) return swept([[0, 0, 0]], ball.radius_m, steps);
  if (capsule) {
    const half = capsule.length_m / 2 - capsule.radius_m;
    return swept(
      [
        [-half, 0, 0],
        [half, 0, 0],
      ],
      capsule.radius_m,
      steps,
    );
  }
  let corners: Vector[];
  if (polyhedron) corners = polyhedron.vertices_m.map(([x = 0, y = 0, z = 0]) => [x, y, z]);
  else if (regular) corners = cornersOf(regular.solid, Array<number>(3).fill(regular.size_m));
  else corners = cornersOf("cube", box?.sides_m ?? Array<number>(3).fill(cube?.side_m ?? 0));
  // Planes about a corner: far from the origin they would lose digits.
  const [first = [0, 0, 0]] = corners;
  const planes = hullPlanes(corners.map((corner) => minus(corner, first)));
  return rounded(within(eroded(planes, radius)), radius, steps);
}

/** Corners of a regular solid with edges of length 1, stretched; none of a solid or a size that is not known. */
function cornersOf(solid: string, [x = 0, y = 0, z = 0]: number[]): Vector[] {
  return regularSolid(solid)?.vertices.map(([a, b, c]): Vector => [a * x, b * y, c * z]) ?? [];
}

class Builder {
  readonly surface: Surface;

  constructor(core: Vector[], radius: number) {
    this.surface = { positions: [], normals: [], triangles: [], core, radius, volume: 0 };
  }

  /** Adds the place at the sphere round a corner of the core, and returns its index. */
  add(corner: Vector, normal: Vector): number {
    this.surface.positions.push(...plus(corner, normal, this.surface.radius));
    this.surface.normals.push(...normal);
    return this.surface.positions.length / 3 - 1;
  }

  /** Adds a grid of places as triangles that look along their normals. */
  grid(rows: number[][]): void {
    for (let i = 1; i < rows.length; i += 1) {
      const [low, high] = [rows[i - 1] ?? [], rows[i] ?? []];
      for (let j = 1; j < low.length; j += 1) {
        this.triangle(low[j - 1], low[j], high[j]);
        this.triangle(low[j - 1], high[j], high[j - 1]);
      }
    }
  }

  triangle(a = 0, b = 0, c = 0): void {
    const at = (values: number[], place: number): Vector => [
      values[3 * place] ?? 0,
      values[3 * place + 1] ?? 0,
      values[3 * place + 2] ?? 0,
    ];
    const [p, q, r] = [a, b, c].map((place) => at(this.surface.positions, place)) as [Vector, Vector, Vector];
    const facing = cross(minus(q, p), minus(r, p));
    const outwards = total([a, b, c].map((place) => at(this.surface.normals, place)));
    if (dot(facing, facing) === 0) return;
    this.surface.triangles.push(...(dot(facing, outwards) >= 0 ? [a, b, c] : [a, c, b]));
  }
}

/** A point or a segment along x, swept by a sphere. */
function swept(core: Vector[], radius: number, steps: number): Surface {
  const builder = new Builder(core, radius);
  const [first = [0, 0, 0], last = first] = [core[0], core[core.length - 1]];
  const rows: number[][] = [];
  const parts = 4 * steps;
  for (let step = 0; step <= parts; step += 1) {
    const along = (step / parts) * Math.PI;
    const row = (corner: Vector) =>
      Array.from({ length: 2 * parts + 1 }, (_, turn) => {
        const about = (turn / parts) * Math.PI;
        return builder.add(corner, [
          -Math.cos(along),
          Math.sin(along) * Math.cos(about),
          Math.sin(along) * Math.sin(about),
        ]);
      });
    rows.push(row(2 * step <= parts ? first : last));
    if (2 * step === parts) rows.push(row(last));
  }
  builder.grid(rows);
  return builder.surface;
}

/** A polyhedral core swept by a sphere: its faces moved out, cylinders round edges, spheres round corners. */
function rounded(core: Polytope, radius: number, steps: number): Surface {
  const builder = new Builder(core.corners, radius);
  const edges = new Map<string, Vector[]>();
  const normals = core.corners.map(() => [] as Vector[]);
  for (const { normal, loop } of core.faces) {
    const places = loop.map((corner) => builder.add(core.corners[corner] ?? normal, normal));
    for (let k = 2; k < places.length; k += 1) builder.triangle(places[0], places[k - 1], places[k]);
    for (const [k, corner] of loop.entries()) {
      const next = loop[(k + 1) % loop.length] ?? corner;
      const key = [corner, next].sort((a, b) => a - b).join(" ");
      edges.set(key, [...(edges.get(key) ?? []), normal]);
      normals[corner]?.push(normal);
    }
  }
  for (const [key, [one, other]] of edges) {
    const ends = key.split(" ").map((corner) => core.corners[Number(corner)]);
    if (one && other)
      builder.grid(ends.map((end) => arc(one, other, steps).map((normal) => builder.add(end ?? one, normal))));
  }
  for (const [corner, about] of normals.entries()) cap(builder, core.corners[corner] ?? [0, 0, 0], about, steps);
  return builder.surface;
}

function arc(from: Vector, to: Vector, steps: number): Vector[] {
  return Array.from({ length: steps + 1 }, (_, step) => slerp(from, to, step / steps));
}

/** The spherical polygon between the normals of the faces that meet in a corner. */
function cap(builder: Builder, corner: Vector, normals: Vector[], steps: number): void {
  const middle = unit(total(normals));
  const [first = middle] = normals;
  const side = unit(minus(first, scaled(middle, dot(first, middle))));
  const angle = (normal: Vector) => Math.atan2(dot(normal, cross(middle, side)), dot(normal, side));
  const sorted = [...normals].sort((a, b) => angle(a) - angle(b));
  for (const [k, from] of sorted.entries()) {
    const outer = arc(from, sorted[(k + 1) % sorted.length] ?? from, steps);
    const rows = Array.from({ length: steps + 1 }, (_, row) =>
      outer.map((normal) => builder.add(corner, slerp(middle, normal, row / steps))),
    );
    builder.grid(rows);
  }
}

/** The surface about its centre of mass, with its volume. */
function centred(surface: Surface): Surface {
  const at = (place: number): Vector => [
    surface.positions[3 * place] ?? 0,
    surface.positions[3 * place + 1] ?? 0,
    surface.positions[3 * place + 2] ?? 0,
  ];
  let volume = 0;
  let moment: Vector = [0, 0, 0];
  for (let k = 0; k < surface.triangles.length; k += 3) {
    const [a, b, c] = [0, 1, 2].map((corner) => at(surface.triangles[k + corner] ?? 0)) as [Vector, Vector, Vector];
    const part = dot(a, cross(b, c)) / 6;
    volume += part;
    moment = plus(moment, total([a, b, c]), part / 4);
  }
  const centre = scaled(moment, 1 / (volume || 1));
  const positions = surface.positions.map((value, place) => value - (centre[place % 3] ?? 0));
  return { ...surface, positions, volume, core: surface.core.map((corner) => minus(corner, centre)) };
}
