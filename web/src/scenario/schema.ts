/** Fields of the scenario, from the JSON Schemas of the contract. */

import type { Schema } from "../api/client";
import { type Json, type JsonObject, isObject, tokens } from "../parts/json-document";

/** Schemas of the contract, by name. */
export type Schemas = Record<string, Schema>;

/** A schema without references and without `null`, which is told apart. */
export interface FieldSchema extends Schema {
  /** Name in the contract, if it has one. */
  name?: string;
  isNullable: boolean;
}

/** Way in which a field is shown. */
export type Kind = "number" | "text" | "flag" | "names" | "vector" | "object" | "variants" | "list" | "json";

/** Longest list of numbers that is shown as inputs side by side. */
const LONGEST_VECTOR = 4;

/** The schema with its references followed. What stands beside a reference goes before. */
export function resolved(schema: Schema, schemas: Schemas): FieldSchema {
  const { $ref, oneOf, ...own } = schema;
  if ($ref !== undefined) {
    const name = $ref.split("/").at(-1) ?? "";
    return { ...resolved(schemas[name] ?? {}, schemas), name, ...own };
  }
  const others = oneOf?.filter(({ type }) => type !== "null");
  const [only] = others ?? [];
  if (oneOf && others?.length === 1 && only) return { ...resolved(only, schemas), ...own, isNullable: true };
  const types = Array.isArray(own.type) ? own.type : [];
  const type = types.find((type) => type !== "null") ?? (own.type as string | undefined);
  const isNullable = types.includes("null") || (oneOf?.length ?? 0) > (others?.length ?? 0);
  return { ...own, ...(type !== undefined && { type }), ...(others && { oneOf: others }), isNullable };
}

/** Kind of a field. */
export function kindOf(schema: FieldSchema, schemas: Schemas): Kind {
  if (schema.enum) return "names";
  if (schema.oneOf) return "variants";
  if (schema.type === "number" || schema.type === "integer") return "number";
  if (schema.type === "string") return "text";
  if (schema.type === "boolean") return "flag";
  if (schema.type === "object" && schema.properties) return "object";
  if (schema.type !== "array" || !schema.items) return "json";
  const items = resolved(schema.items, schemas);
  if (items.type === "object") return "list";
  const isShort = schema.minItems === schema.maxItems && (schema.maxItems ?? Infinity) <= LONGEST_VECTOR;
  return items.type === "number" && isShort ? "vector" : "json";
}

/** Unit of a field, or of the numbers in its lists. */
export function unitOf(schema: Schema): string | undefined {
  return schema["x-unit"] ?? (schema.items && unitOf(schema.items));
}

/** A form that a field may take. */
export interface Variant {
  schema: FieldSchema;
  /** The only key of its object, which tells it from the others; undefined if there is none. */
  key: string | undefined;
}

/** Forms that a field may take. */
export function variantsOf(schema: FieldSchema, schemas: Schemas): Variant[] {
  return (schema.oneOf ?? []).map((form) => {
    const own = resolved(form, schemas);
    const keys = Object.keys(own.properties ?? {});
    return { schema: own, key: keys.length === 1 && own.required?.[0] === keys[0] ? keys[0] : undefined };
  });
}

/** Index of the form that a value has; −1 if it has none of them. */
export function variantOf(variants: Variant[], value: Json | undefined): number {
  if (!isObject(value)) return -1;
  const tagged = variants.findIndex(({ key }) => key !== undefined && Object.hasOwn(value, key));
  if (tagged >= 0) return tagged;
  const has = (key: string) => Object.hasOwn(value, key);
  return variants.findIndex(({ key, schema }) => key === undefined && (schema.required ?? []).every(has));
}

/** Schema of the field at a pointer of a document, if there is such a field. */
export function schemaAt(pointer: string, document: JsonObject, schemas: Schemas): FieldSchema | undefined {
  let here: FieldSchema | undefined = resolved({ $ref: "#/components/schemas/Scenario" }, schemas);
  let value: Json | undefined = document;
  for (const token of tokens(pointer)) {
    if (here?.oneOf) {
      const variants = variantsOf(here, schemas);
      here = variants[variantOf(variants, value)]?.schema;
    }
    const next: Schema | undefined = here?.items ?? here?.properties?.[token];
    here = next && resolved(next, schemas);
    value = Array.isArray(value) ? value[Number(token)] : isObject(value) ? value[token] : undefined;
  }
  return here;
}

/** A scenario without what is as by default: what its author may have written. */
export function withoutDefaults(value: Json, schema: FieldSchema, schemas: Schemas): Json {
  if (Array.isArray(value)) {
    const items = schema.items && resolved(schema.items, schemas);
    return items ? value.map((item) => withoutDefaults(item, items, schemas)) : value;
  }
  if (!isObject(value)) return value;
  const variants = schema.oneOf && variantsOf(schema, schemas);
  const own = variants ? (variants[variantOf(variants, value)]?.schema ?? schema) : schema;
  const members = Object.entries(value).flatMap(([key, item]): [string, Json][] => {
    const property = own.properties?.[key];
    if (!property) return [[key, item]];
    const field = resolved(property, schemas);
    const rest = withoutDefaults(item, field, schemas);
    const isRequired = own.required?.includes(key) ?? false;
    return !isRequired && isDefault(rest, field) ? [] : [[key, rest]];
  });
  return Object.fromEntries(members);
}

function isDefault(value: Json, schema: FieldSchema): boolean {
  if (isObject(value)) return Object.keys(value).length === 0 && schema.default !== null;
  if (value === null) return schema.isNullable;
  return JSON.stringify(value) === JSON.stringify(schema.default);
}
