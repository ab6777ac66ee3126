/** Differences of two JSON documents, by JSON pointer. */

import { member } from "../../parts/json-document";

/** A field that two documents do not have in common. */
export interface Difference {
  pointer: string;
  first: unknown;
  second: unknown;
}

/** All differing fields, in the order of the first document and then of the second; undefined: it is not there. */
export function differencesOf(first: unknown, second: unknown, pointer = ""): Difference[] {
  if (isObject(first) && isObject(second) && Array.isArray(first) === Array.isArray(second)) {
    const keys = new Set([...Object.keys(first), ...Object.keys(second)]);
    return [...keys].flatMap((key) => differencesOf(first[key], second[key], member(pointer, key)));
  }
  return JSON.stringify(first) === JSON.stringify(second) ? [] : [{ pointer, first, second }];
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null;
}
