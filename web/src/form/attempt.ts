/** Attempts to submit a scenario: one name for all of them, so that they make one job. */

import { ServiceProblem } from "../api/problem";

/** A submission that is kept until it is answered for good. */
export interface Attempt {
  key: string;
  path: string;
  body: string;
}

/** A name that no other submission has. Plain HTTP has no `randomUUID`. */
export function newKey(): string {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return [...bytes].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}

/** The attempt to repeat if it is for the same request, else a new one. */
export function attemptFor(scenario: unknown, label: string, before: Attempt | undefined): Attempt {
  const path = label === "" ? "v1/jobs" : `v1/jobs?label=${encodeURIComponent(label)}`;
  const body = JSON.stringify(scenario);
  return before?.path === path && before.body === body ? before : { key: newKey(), path, body };
}

/** True if the same request may still be answered otherwise, so that its key is kept. */
export function isPassing(problem: unknown): boolean {
  return (
    !(problem instanceof ServiceProblem) || [0, 401, 408, 409, 429].includes(problem.status) || problem.status >= 500
  );
}
