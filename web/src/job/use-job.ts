import { useEffect, useRef, useState } from "preact/hooks";
import { type Job, type Progress, api, data } from "../api/client";
import { onServiceEvent } from "../events/events";
import { type Answer, useAnswer } from "../parts/use-answer";

/** A job, kept up to date by the service's events. */
export interface LiveJob extends Answer<Job> {
  isRemoved: boolean;
}

/** Asks for a job, again whenever its state changes, and takes its progress from the events. */
export function useJob(id: string): LiveJob {
  const answer = useAnswer<Job>((signal) => data(api.GET("/v1/jobs/{id}", { params: { path: { id } }, signal })), [id]);
  const [progress, setProgress] = useState<Progress>();
  const [isRemoved, setIsRemoved] = useState(false);
  const again = useRef(answer.again);
  again.current = answer.again;
  useEffect(
    () =>
      onServiceEvent((event) => {
        if (event.kind === "reset") again.current();
        else if (event.id !== id) return;
        else if (event.kind === "progress") setProgress(event.progress as Progress);
        else if (event.kind === "removed") setIsRemoved(true);
        else {
          setProgress(undefined);
          again.current();
        }
      }),
    [id],
  );
  const job = answer.value;
  const isRunning = job?.status === "running";
  return { ...answer, value: job && isRunning && progress ? { ...job, progress } : job, isRemoved };
}
