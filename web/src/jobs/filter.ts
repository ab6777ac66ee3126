/** Filter of the list of jobs. */

import type { JobStatus } from "../api/client";

export const STATUSES: readonly JobStatus[] = ["accepted", "running", "successful", "failed", "dismissed"];

/** Jobs that are listed; empty parts leave all in. */
export interface Filter {
  statuses: JobStatus[];
  label: string;
  /** First and last day of acceptance, as `2026-11-30`, in the reader's time zone. */
  from: string;
  to: string;
}

export const ALL: Filter = { statuses: [], label: "", from: "", to: "" };

/** Parameters of the request for the jobs of a filter. */
export function query(filter: Filter) {
  const start = (day: string) => new Date(`${day}T00:00:00`).toISOString();
  const end = (day: string) => new Date(`${day}T23:59:59.999`).toISOString();
  return {
    ...(filter.statuses.length > 0 && { status: filter.statuses }),
    ...(filter.label !== "" && { label: filter.label }),
    ...(filter.from !== "" && { created_from: start(filter.from) }),
    ...(filter.to !== "" && { created_to: end(filter.to) }),
  };
}
