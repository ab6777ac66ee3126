/** Attempts to submit a scenario: one name for all of them, so that they make one job. */

import { uniqueKey } from "../parts/unique-key";

/** A submission that is kept until it is answered for good. */
export interface Attempt {
  key: string;
  path: string;
  body: string;
}

/** The attempt to repeat if it is for the same request, else a new one. */
export function attemptFor(scenario: unknown, label: string, before: Attempt | undefined): Attempt {
  const path = label === "" ? "v1/jobs" : `v1/jobs?label=${encodeURIComponent(label)}`;
  const body = JSON.stringify(scenario);
  return before?.path === path && before.body === body ? before : { key: uniqueKey(), path, body };
}
