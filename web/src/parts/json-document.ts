/** The scenario document: plain JSON, read and changed by JSON pointers (RFC 6901). */

/** A JSON value. */
export type Json = null | boolean | number | string | Json[] | JsonObject;

/** A JSON object. */
export type JsonObject = { [key: string]: Json };

/** True of a JSON object, which is no list. */
export function isObject(value: Json | undefined): value is JsonObject {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/** Keys and indices of a pointer. */
export function tokens(pointer: string): string[] {
  const escaped = pointer.split("/").slice(1);
  return escaped.map((token) => token.replaceAll("~1", "/").replaceAll("~0", "~"));
}

/** Pointer to the member of what `pointer` leads to. */
export function member(pointer: string, key: string | number): string {
  return `${pointer}/${String(key).replaceAll("~", "~0").replaceAll("/", "~1")}`;
}

/** Pointer to what holds the value at `pointer`. */
export function parentOf(pointer: string): string {
  return pointer.slice(0, Math.max(0, pointer.lastIndexOf("/")));
}

/** All pointers on the way to `pointer`, itself included and the document's left out. */
export function prefixes(pointer: string): string[] {
  const parts = pointer.split("/").slice(1);
  return parts.map((_, index) => `/${parts.slice(0, index + 1).join("/")}`);
}

/** Value at a pointer; undefined if there is none. */
export function at(document: Json | undefined, pointer: string): Json | undefined {
  let here: Json | undefined = document;
  for (const token of tokens(pointer)) here = child(here, token);
  return here;
}

function child(value: Json | undefined, token: string): Json | undefined {
  if (Array.isArray(value)) return value[Number(token)];
  return isObject(value) && Object.hasOwn(value, token) ? value[token] : undefined;
}

/** A document with this value at the pointer, or without the member if it is undefined. What
 * stands in the way and is no object becomes one. */
export function changed(document: JsonObject, pointer: string, value: Json | undefined): JsonObject {
  const next = put(document, tokens(pointer), value);
  return isObject(next) ? next : document;
}

function put(here: Json | undefined, [token, ...rest]: string[], value: Json | undefined): Json | undefined {
  if (token === undefined) return value;
  const inner = put(child(here, token), rest, value);
  if (Array.isArray(here)) {
    const index = Number(token);
    return inner === undefined ? here.filter((_, at) => at !== index) : Object.assign([...here], { [index]: inner });
  }
  const { [token]: _, ...others } = isObject(here) ? here : {};
  if (inner === undefined) return others;
  return isObject(here) && Object.hasOwn(here, token) ? { ...here, [token]: inner } : { ...others, [token]: inner };
}

/** True of equal values, whatever the order of their keys. */
export function same(one: Json | undefined, other: Json | undefined): boolean {
  if (one === other) return true;
  if (Array.isArray(one) && Array.isArray(other)) {
    return one.length === other.length && one.every((item, index) => same(item, other[index]));
  }
  if (!isObject(one) || !isObject(other)) return false;
  const keys = Object.keys(one);
  return keys.length === Object.keys(other).length && keys.every((key) => same(one[key], other[key]));
}

/** A field whose value differs from the original's; undefined where there is none. */
export interface Difference {
  pointer: string;
  was: Json | undefined;
  is: Json | undefined;
}

/** All fields in which two documents differ. Lists of numbers are one field. */
export function differences(was: Json | undefined, is: Json | undefined, pointer = ""): Difference[] {
  if (same(was, is)) return [];
  const keys = memberKeys(was, is);
  if (keys === undefined) return [{ pointer, was, is }];
  return keys.flatMap((key) => differences(child(was, key), child(is, key), member(pointer, key)));
}

/** Members to compare one by one; undefined if the values are compared as wholes. */
function memberKeys(was: Json | undefined, is: Json | undefined): string[] | undefined {
  const emptyIfMissing = (value: Json | undefined, other: Json | undefined) =>
    value === undefined && isObject(other) ? {} : value;
  const [one, two] = [emptyIfMissing(was, is), emptyIfMissing(is, was)];
  if (isObject(one) && isObject(two)) return [...new Set([...Object.keys(one), ...Object.keys(two)])];
  if (!Array.isArray(one) || !Array.isArray(two) || ![...one, ...two].every(isObject)) return undefined;
  return Array.from({ length: Math.max(one.length, two.length) }, (_, index) => String(index));
}
