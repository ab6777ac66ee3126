/** Submission of the scenario as a job, once however often it is tried. */

import { type Job, request } from "../api/client";
import type { Attempt } from "./attempt";

/** Submits, and returns the job. */
export async function submit({ key, path, body }: Attempt): Promise<Job> {
  const headers = { "Content-Type": "application/json", "Idempotency-Key": key };
  const answer = await request(path, { method: "POST", headers, body });
  return (await answer.json()) as Job;
}
