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
  // An ended job is asked for again after a reset, but does not change: pictures need not be made again.
  const kept = useRef<Job>();
  const isSame = kept.current?.finished && kept.current.finished === answer.value?.finished;
  const job = isSame ? kept.current : answer.value;
  kept.current = job;
  const isRunning = job?.status === "running";
  return { ...answer, value: job && isRunning && progress ? { ...job, progress } : job, isRemoved };
}
