/** Changes of the scenario document that keep it as short as its author would write it. */

import { snapped } from "../parts/round-values";
import { type Json, type JsonObject, at, changed, isObject, member, parentOf, tokens } from "../parts/json-document";
import type { Scene } from "../scenario/scene";
import { type Schemas, schemaAt } from "../scenario/schema";
import { solidOf } from "../scenario/solid";

/** The document with this value; a field that is taken away takes objects with it that it leaves
 * empty, as long as leaving them out means the same. */
export function editedDocument(
  document: JsonObject,
  pointer: string,
  value: Json | undefined,
  schemas: Schemas,
): JsonObject {
  let next = changed(document, pointer, value);
  if (value !== undefined) return next;
  for (let here = parentOf(pointer); here !== "" && isSpare(next, here, schemas); here = parentOf(here)) {
    next = changed(next, here, undefined);
  }
  return next;
}

function isSpare(document: JsonObject, pointer: string, schemas: Schemas): boolean {
  const value = at(document, pointer);
  const owner = schemaAt(parentOf(pointer), document, schemas);
  const schema = schemaAt(pointer, document, schemas);
  if (!isObject(value) || Object.keys(value).length > 0) return false;
  if (!owner?.properties || !schema || schema.isNullable || schema.oneOf) return false;
  return !owner.required?.includes(tokens(pointer).at(-1) ?? "");
}

/** A shape to begin with, about as large as the one before. */
export function shapeOf(name: string, before: Json | undefined): JsonObject {
  const size = solidOf(before, undefined)?.reach ?? 0.04;
  const half = size / 2;
  const starters: Record<string, JsonObject> = {
    cube: { side_m: size },
    box: { sides_m: [size, size, size] },
    regular: { solid: "dodecahedron", size_m: round(size / 2.8) },
    polyhedron: {
      vertices_m: [
        [-half, -half, 0],
        [half, -half, 0],
        [0, half, 0],
        [0, 0, size],
      ],
    },
    ball: { radius_m: half },
    capsule: { radius_m: size / 4, length_m: size },
  };
  return { [name]: starters[name] ?? {} };
}

/** A list with one more item: a copy of another where there is one. */
export function withItem(list: Json[], copied: number | undefined, name: string, scene: Scene | undefined): Json[] {
  const original = copied === undefined ? undefined : list[copied];
  if (name !== "Body") return [...list, original ?? {}];
  const at = copied === undefined ? list.length : copied + 1;
  return [...list.slice(0, at), bodyBeside(original, list, scene), ...list.slice(at)];
}

/** A body where none is yet: downstream of all others, or east of them on a terrain. */
function bodyBeside(original: Json | undefined, list: Json[], scene: Scene | undefined): Json {
  const body: Json = original ?? { shape: { cube: { side_m: 0.04 } } };
  const size = solidOf(at(body, "/shape"), at(body, "/sphero_radius_m"))?.reach ?? 0.04;
  const easts = list.map((other) => at(other, "/position/east_m")).filter((east) => typeof east === "number");
  if (isObject(body) && typeof at(body, "/position/east_m") === "number") {
    return changed(body, "/position/east_m", snapped(Math.max(...easts) + 2 * size, round(size / 40)));
  }
  const others = scene?.bodies ?? [];
  if (!isObject(body) || others.length === 0) return body;
  const farthest = Math.max(...others.map(({ centre, solid }) => centre[0] + solid.reach / 2));
  return changed(body, "/position/downstream_m", snapped(farthest + size, round(size / 40)));
}

function round(value: number): number {
  return Number(value.toPrecision(1));
}

/** The list without one of its items. */
export function withoutItem(list: Json[], index: number): Json[] {
  return list.filter((_, at) => at !== index);
}

/** Accuracy asked of the answer, as the slider has it. */
export type Asked = "off" | "error_bars" | number;

/** Accuracy that a document asks for. */
export function askedOf(document: JsonObject): Asked {
  const target = at(document, "/accuracy/target");
  if (typeof target === "number") return target;
  return at(document, "/accuracy/error_bars") === true ? "error_bars" : "off";
}

/** The document that asks for this accuracy. A target chooses the cells, so that a given cell size
 * goes; without one there is no quantity. */
export function asking(document: JsonObject, asked: Asked, schemas: Schemas): JsonObject {
  const set = (document: JsonObject, key: string, value: Json | undefined) =>
    editedDocument(document, member("/accuracy", key), value, schemas);
  let next = set(document, "error_bars", asked === "error_bars" ? true : undefined);
  next = set(next, "target", typeof asked === "number" ? asked : undefined);
  if (typeof asked !== "number") {
    for (const key of ["quantity", "body", "budget_point_steps"]) next = set(next, key, undefined);
    return next;
  }
  const bodies = at(document, "/bodies");
  const quantity = Array.isArray(bodies) && bodies.length > 0 ? "displacement_m" : "runout_m";
  if (at(next, "/accuracy/quantity") === undefined) next = set(next, "quantity", quantity);
  return editedDocument(next, "/numerics/cell_size_m", undefined, schemas);
}
