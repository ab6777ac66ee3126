import type { JobStatus } from "../api/client";

const ENDED: ReadonlySet<JobStatus> = new Set(["successful", "failed", "dismissed"] as const);

/** True for a job that has ended. */
export function hasEnded(status: JobStatus): boolean {
  return ENDED.has(status);
}
