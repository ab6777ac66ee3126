/** Solids of bodies in body axes, from the shapes of a scenario. */

import { centreOf, facesOf } from "../geometry/polyhedron";
import { regularSolid } from "../geometry/regular";
import { type Vector, length, minus, scaled } from "../geometry/vectors";
import { type Json, isObject } from "../parts/json-document";

/** A core about the centre of mass, swept by a ball. */
export interface Solid {
  core: Vector[];
  radius: number;
  /** Length by which a body is placed clear of the foot of the incline, if nothing else is said [m]. */
  reach: number;
  /** Size in words: `cube 0.04 m`. */
  text: string;
}

/** Thickness over the sphero radius, if none is given. */
const THICKNESS_PER_RADIUS = 20;

/** The number, if it is a positive one. */
export function positive(value: Json | undefined): number | undefined {
  return typeof value === "number" && value > 0 ? value : undefined;
}

/** The vector, if it is one of numbers. */
export function vectorOf(value: Json | undefined): Vector | undefined {
  const isVector = Array.isArray(value) && value.length === 3 && value.every((part) => typeof part === "number");
  return isVector ? (value as unknown as Vector) : undefined;
}

/** Solid of a shape; undefined if its dimensions make none, or the shape is not known. */
export function solidOf(shape: Json | undefined, givenRadius: Json | undefined): Solid | undefined {
  const [name, size] = isObject(shape) ? (Object.entries(shape)[0] ?? []) : [];
  if (name === undefined || !isObject(size)) return undefined;
  return Object.hasOwn(MAKERS, name) ? MAKERS[name]?.(size, positive(givenRadius)) : undefined;
}

type Maker = (size: { [key: string]: Json }, radius: number | undefined) => Solid | undefined;

const MAKERS: Record<string, Maker> = {
  cube({ side_m }, radius) {
    const side = positive(side_m);
    return side === undefined ? undefined : cuboid([side, side, side], radius, `cube ${side} m`);
  },
  box({ sides_m }, radius) {
    const sides = vectorOf(sides_m);
    if (!sides?.every((side) => side > 0)) return undefined;
    return cuboid(sides, radius, `box ${sides.join(" × ")} m`);
  },
  regular({ solid, size_m }, radius) {
    const edge = positive(size_m);
    const regular = regularSolid(String(solid));
    if (edge === undefined || !regular) return undefined;
    const inradius = regular.inradius * edge;
    const rounding = rounded(radius, 2 * inradius);
    const vertices = regular.vertices.map((vertex) => scaled(vertex, edge));
    // Planes at equal distances from the centre move inwards by a change of scale.
    const core = vertices.map((vertex) => scaled(vertex, 1 - rounding / inradius));
    return { core, radius: rounding, reach: farthest(vertices), text: `${String(solid)}, edges ${edge} m` };
  },
  polyhedron({ vertices_m }) {
    const points = Array.isArray(vertices_m) ? vertices_m.map(vectorOf) : [];
    if (points.length > MOST_VERTICES || !points.every((point) => point !== undefined)) return undefined;
    const hull = hullOf(vertices_m as Json[], points);
    // Drawn without its rounding, which is small and does not move the faces.
    return hull && { core: hull, radius: 0, reach: farthest(hull), text: `polyhedron of ${points.length} vertices` };
  },
  ball({ radius_m }) {
    const radius = positive(radius_m);
    return radius === undefined
      ? undefined
      : { core: [[0, 0, 0]], radius, reach: 2 * radius, text: `ball, radius ${radius} m` };
  },
  capsule({ radius_m, length_m }) {
    const [radius, whole] = [positive(radius_m), positive(length_m)];
    if (radius === undefined || whole === undefined) return undefined;
    const half = Math.max(0, whole / 2 - radius);
    const text = `capsule ${whole} m, radius ${radius} m`;
    return {
      core: [
        [-half, 0, 0],
        [half, 0, 0],
      ],
      radius,
      reach: whole,
      text,
    };
  },
};

/** Most vertices of a polyhedron that are drawn, those that the service takes. */
const MOST_VERTICES = 32;

const hulls = new WeakMap<Json[], Vector[] | undefined>();

/** The points about the centre of mass of their hull, once for each list. */
function hullOf(list: Json[], points: Vector[]): Vector[] | undefined {
  if (!hulls.has(list)) {
    const faces = points.length < 4 ? [] : facesOf(points);
    const centre = centreOf(faces);
    hulls.set(list, faces.length === 0 ? undefined : points.map((point) => minus(point, centre)));
  }
  return hulls.get(list);
}

function cuboid(sides: Vector, given: number | undefined, text: string): Solid {
  const radius = rounded(given, Math.min(...sides));
  const [x, y, z] = sides.map((side) => side / 2 - radius) as unknown as Vector;
  const core = [-1, 1].flatMap((a) => [-1, 1].flatMap((b) => [-1, 1].map((c): Vector => [a * x, b * y, c * z])));
  return { core, radius, reach: Math.max(...sides), text };
}

/** Sphero radius: the given one as far as it leaves a core, or a share of the thickness. */
function rounded(given: number | undefined, thickness: number): number {
  return Math.min(given ?? thickness / THICKNESS_PER_RADIUS, thickness / 2);
}

function farthest(vertices: Vector[]): number {
  return Math.max(...vertices.flatMap((a) => vertices.map((b) => length(minus(a, b)))));
}
