/** States of the scenario document to go back and forth between. */

import { type JsonObject, same } from "../parts/json-document";

/** A document with those before and after it. */
export interface History {
  past: JsonObject[];
  present: JsonObject;
  future: JsonObject[];
  /** Edit that made the present one; a further part of the same edit replaces it. */
  edit: string;
  /** Time of that edit [ms]. */
  time: number;
}

/** Largest number of steps back. */
const STEPS = 200;

/** Time after which a further change of the same field is a step of its own [ms]. */
const PAUSE_MS = 2000;

/** History that begins with a document. */
export function begin(present: JsonObject): History {
  return { past: [], present, future: [], edit: "", time: 0 };
}

/** History after an edit: changes of one field in quick succession are one step. */
export function edited(history: History, present: JsonObject, edit: string, time: number): History {
  if (same(present, history.present)) return history;
  const isFurther = edit !== "" && edit === history.edit && time - history.time < PAUSE_MS;
  const past = isFurther ? history.past : [...history.past, history.present].slice(-STEPS);
  return { past, present, future: [], edit, time };
}

/** History one step back; itself at its beginning. */
export function undone(history: History): History {
  const before = history.past.at(-1);
  if (before === undefined) return history;
  const future = [history.present, ...history.future];
  return { past: history.past.slice(0, -1), present: before, future, edit: "", time: 0 };
}

/** History one step forth; itself at its end. */
export function redone(history: History): History {
  const [after, ...future] = history.future;
  if (after === undefined) return history;
  return { past: [...history.past, history.present], present: after, future, edit: "", time: 0 };
}
