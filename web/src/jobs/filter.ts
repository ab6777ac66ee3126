/** Filter of the list of jobs. */

import type { JobStatus, JobSummary } from "../api/client";

export const STATUSES: readonly JobStatus[] = ["accepted", "running", "successful", "failed", "dismissed"];

/** Jobs that are listed; empty parts leave all in. */
export interface Filter {
  statuses: JobStatus[];
  label: string;
  /** First and last day of acceptance, as `2026-11-30`, in the reader's time zone. */
  from: string;
  to: string;
  /** True if members of studies are listed, too. */
  members: boolean;
}

export const ALL: Filter = { statuses: [], label: "", from: "", to: "", members: false };

/** Beginning of the label that tells the study of a job. */
const STUDY = "study:";

/** Identifier of the study whose member a job is. */
export function studyOf(job: JobSummary): string | undefined {
  return job.labels.find((label) => label.startsWith(STUDY))?.slice(STUDY.length);
}

/** Parameters of the request for the jobs of a filter. */
export function query(filter: Filter) {
  return {
    ...(filter.statuses.length > 0 && { status: filter.statuses }),
    ...(filter.label !== "" && { label: filter.label }),
    // A label asked for may be that of a study.
    ...(filter.label === "" && !filter.members && { members: false }),
    ...(isDay(filter.from) && { created_from: new Date(`${filter.from}T00:00:00`).toISOString() }),
    ...(isDay(filter.to) && { created_to: new Date(`${filter.to}T23:59:59.999`).toISOString() }),
  };
}

/** True for a day with a year of four digits: while it is typed, it may have more, and the limit of a field does
 * not keep them out. */
function isDay(text: string): boolean {
  return /^\d{4}-\d\d-\d\d$/.test(text);
}
