/** Drafts that survive a reload: one for each address of the form, in the session storage. */

import type { JsonObject } from "../parts/json-document";

/** A scenario that is being written, and where it began. */
export interface Draft {
  document: JsonObject;
  original: JsonObject;
  /** What the original is, as "the example". */
  from: string;
  /** True if the original is of a file, and not what the address names. */
  isOfFile: boolean;
}

const keyOf = (address: string) => `scree-draft ${address}`;

/** Draft of an address, if there is one. */
export function readDraft(address: string): Draft | undefined {
  try {
    const text = sessionStorage.getItem(keyOf(address));
    return text === null ? undefined : (JSON.parse(text) as Draft);
  } catch {
    return undefined;
  }
}

/** Keeps a draft, or forgets it. A full storage keeps none: the form works without. */
export function keepDraft(address: string, draft: Draft | undefined): void {
  try {
    if (draft) sessionStorage.setItem(keyOf(address), JSON.stringify(draft));
    else sessionStorage.removeItem(keyOf(address));
  } catch {
    sessionStorage.removeItem(keyOf(address));
  }
}
