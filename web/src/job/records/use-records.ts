/** Records of a job as its view needs them. */

import { useMemo, useState } from "preact/hooks";
import type { Job } from "../../api/client";
import { type Answer, useAnswer } from "../../parts/use-answer";
import type { FlowFrame } from "../flow/decoder";
import { FrameReader } from "../flow/read-frames";
import { TrajectoryReader } from "./read-trajectories";
import type { Curves, Poses } from "./trajectories";

/** Times that records are read while a job runs, fewer if that takes more requests than so many. */
const READINGS = 20;
const MOST_REQUESTS = 400;

/** Changes whenever there is enough new to read a job's records again, which takes so many requests: at its end, and
 * some times on the way. */
function epochOf(job: Job | undefined, requests = 1): string {
  if (!job || job.status === "accepted") return "";
  const readings = Math.max(1, Math.min(READINGS, Math.floor(MOST_REQUESTS / requests)));
  return job.status === "running" ? `running ${Math.floor(readings * job.progress.fraction)}` : job.status;
}

/** Poses of all bodies of a job that has started. */
export function usePoses(job: Job | undefined): Answer<Poses[]> {
  const epoch = epochOf(job, job?.scenario.bodies.length);
  const reader = useMemo(() => new TrajectoryReader(), [job?.id]);
  return useAnswer(async (signal) => (job && epoch ? reader.readPoses(job, signal) : []), [job?.id, epoch]);
}

/** Curves of the chosen bodies. */
export function useCurves(job: Job, bodies: readonly number[]): Answer<Curves[]> {
  const reader = useMemo(() => new TrajectoryReader(), [job.id]);
  const epoch = epochOf(job, bodies.length);
  return useAnswer((signal) => reader.readCurves(job, bodies, signal), [job.id, epoch, bodies.join(" ")]);
}

/** Frames of a job's flow, how many of how many are there, and what went wrong. */
export interface Frames {
  frames: FlowFrame[] | undefined;
  read: number;
  of: number;
  problem: unknown;
}

/** Frames of the flow; none for a job without flow. */
export function useFrames(job: Job | undefined): Frames {
  const [count, setCount] = useState({ read: 0, of: 0 });
  const epoch = epochOf(job);
  const reader = useMemo(() => new FrameReader(), [job?.id]);
  const { value, problem } = useAnswer(
    async (signal) => {
      if (!job || !epoch) return undefined;
      return job.scenario.flow === null ? NONE : reader.read(job, (read, of) => setCount({ read, of }), signal);
    },
    [job?.id, epoch],
  );
  return { frames: value, ...count, problem };
}

const NONE: FlowFrame[] = [];
