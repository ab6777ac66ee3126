/** Words of the form, from keys, descriptions and limits of the schema. */

import type { Schema } from "../api/client";
import { figure } from "../parts/format";
import { type Json, type JsonObject, prefixes, tokens } from "../parts/json-document";
import { wordsOfKey } from "../parts/words";
import { type FieldSchema, type Schemas, schemaAt, unitOf } from "../scenario/schema";

/** A unit as it is written at the end of keys: `m/s²` is `m_s2`. */
function ending(unit: string): string {
  const plain = unit.replace("°", "deg").replace("²", "2").replace("³", "3");
  return `_${plain.replace("/", "_").toLowerCase()}`;
}

/** Label of a field: its key in words, without the unit. */
export function labelOf(key: string, unit?: string): string {
  const end = unit === undefined ? undefined : ending(unit);
  const bare = end !== undefined && key.endsWith(end) ? key.slice(0, -end.length) : key;
  const words = bare.replaceAll("_", " ").replace("youngs", "Young's").replace("poissons", "Poisson's");
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/** Name of an object from that of its schema. */
export function objectName(schema: string): string {
  return schema === "TerrainRelease" ? "Release" : labelOf(schema);
}

/** Name of one of several values, as of a quantity: its key in words. */
export function nameOf(value: unknown): string {
  return wordsOfKey(String(value));
}

/** A description taken apart. */
export interface Described {
  help: string;
  /** Default in words, if it is no value. */
  fallback: string | undefined;
}

/** Help and default of a description, without the unit, which stands beside the input. */
export function described(schema: Schema): Described {
  const [help = "", fallback] = (schema.description ?? "").split(/\s*\bDefault: /);
  const unit = unitOf(schema);
  const text = help.replace(/\s+/g, " ").replaceAll("`", "").replace("null:", "left empty:");
  const plain = unit === undefined ? text : text.replace(` [${unit}]`, "");
  return { help: plain, fallback: fallback?.replace(/\s+/g, " ").replaceAll("`", "").replace(/\.$/, "") };
}

/** Range of a number in words: `0 to 89`, `above 0, at most 0.9`. */
export function rangeOf(schema: Schema): string | undefined {
  const { minimum, maximum, exclusiveMinimum, exclusiveMaximum } = schema;
  if (minimum !== undefined && maximum !== undefined) return `${figure(minimum)} to ${figure(maximum)}`;
  const low =
    minimum !== undefined
      ? `at least ${figure(minimum)}`
      : exclusiveMinimum !== undefined
        ? `above ${figure(exclusiveMinimum)}`
        : undefined;
  const high =
    maximum !== undefined
      ? `at most ${figure(maximum)}`
      : exclusiveMaximum !== undefined
        ? `below ${figure(exclusiveMaximum)}`
        : undefined;
  return [low, high].filter((part) => part !== undefined).join(", ") || undefined;
}

/** What an empty input stands for. */
export function placeholderOf(schema: FieldSchema, isRequired: boolean): string {
  if (isRequired) return "";
  if (typeof schema.default === "number") return `default: ${schema.default}`;
  if (typeof schema.default === "string" && schema.default !== "") return `default: ${schema.default}`;
  return schema.isNullable || described(schema).fallback !== undefined ? "automatic" : "";
}

/** Name of a field in a sentence: `Channel › Inclination`. */
export function fieldName(pointer: string, document: JsonObject, schemas: Schemas): string {
  const names: string[] = [];
  for (const prefix of prefixes(pointer)) {
    const token = tokens(prefix).at(-1) ?? "";
    const schema = schemaAt(prefix, document, schemas);
    if (/^\d+$/.test(token) && schema?.name) names.splice(-1, 1, `${objectName(schema.name)} ${token}`);
    else names.push(labelOf(token, schema && unitOf(schema)));
  }
  return names.join(" › ") || "Scenario";
}

/** A value in a sentence. */
export function valueText(value: Json | undefined, unit?: string): string {
  if (value === undefined) return "default";
  if (value === null) return "none";
  const text = typeof value === "string" ? value : JSON.stringify(value).replaceAll(",", ", ");
  const short = text.length > 48 ? `${text.slice(0, 47)}…` : text;
  return unit !== undefined && typeof value !== "string" ? `${short} ${unit}` : short;
}
