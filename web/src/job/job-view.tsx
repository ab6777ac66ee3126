import "./job.css";
import { useEffect, useMemo } from "preact/hooks";
import { Link } from "wouter-preact";
import type { Job } from "../api/client";
import { ProblemNotice } from "../parts/problem-notice";
import { useTitle } from "../parts/use-title";
import { groundOf } from "../scenario/ground";
import { FailureNotice } from "./head/failure";
import { Head } from "./head/head";
import { Audit, Quantities, Story } from "./outcome/outcome-section";
import { PlanAndCost } from "./outcome/plan-section";
import { Clock } from "./playback/clock";
import { CurvesSection } from "./plots/curves-section";
import { recordedTime } from "./records/trajectories";
import { useFrames, usePoses } from "./records/use-records";
import { Replay, useContent } from "./replay";
import { Downloads } from "./take/downloads";
import { Recipes } from "./take/recipes-section";
import { useJob } from "./use-job";

/** View of one job: how far it is, what came out, whether to trust it, and how to take it along. */
export function JobView({ id }: { id: string }) {
  const { value: job, problem, again, isRemoved } = useJob(id);
  useTitle(job?.scenario.title || "Job");
  if (isRemoved) return <Gone />;
  if (!job) return <NotRead problem={problem} />;
  return (
    <article class="job">
      <Head job={job} again={again} />
      {problem ? <ProblemNotice problem={problem} /> : null}
      {job.problem && <FailureNotice problem={job.problem} id={id} />}
      <Records job={job} />
      <PlanAndCost job={job} />
      <Downloads job={job} />
      <Recipes scenario={job.scenario} />
    </article>
  );
}

/** What the run has recorded: all of it after its end, what there is so far before. */
function Records({ job }: { job: Job }) {
  const clock = useMemo(() => new Clock(), [job.id]);
  const poses = usePoses(job);
  const flow = useFrames(job);
  const content = useContent(job, poses.value, flow);
  const end = recordedTime(job);
  useEffect(() => clock.setEnd(end), [clock, end]);
  useEffect(() => () => clock.pause(), [clock]);
  const submergence = useMemo(() => poses.value?.map(({ lastSubmergence }) => lastSubmergence) ?? [], [poses.value]);
  const hasStarted = job.status !== "accepted" && job.started !== null;
  return (
    <>
      {job.outcome && <Story job={job} submergence={submergence} />}
      {!job.outcome && hasStarted && <p class="quiet">{soFar(job)}</p>}
      {poses.problem ? <ProblemNotice problem={poses.problem} /> : null}
      {hasStarted && !content && !poses.problem && <p class="quiet">Reading the trajectories …</p>}
      {hasStarted && content && <Replay content={content} flow={flow} clock={clock} />}
      {hasStarted && job.scenario.bodies.length > 0 && <CurvesSection job={job} clock={clock} />}
      {job.outcome && <Quantities outcome={job.outcome} ground={groundOf(job.scenario)} />}
      {job.outcome && <Audit outcome={job.outcome} ground={groundOf(job.scenario)} />}
    </>
  );
}

function soFar({ status, progress }: Job): string {
  const time = `${progress.simulated_time_s.toFixed(3)} s`;
  if (status === "running") return `What has been computed so far, up to ${time}, is shown below and grows.`;
  return `The run ended at ${time} without an outcome; what it had recorded is shown below.`;
}

function NotRead({ problem }: { problem: unknown }) {
  return (
    <>
      <h1>Job</h1>
      {problem ? <ProblemNotice problem={problem} /> : <p class="quiet">Reading the job …</p>}
      <p>
        <Link href="/">All jobs</Link>
      </p>
    </>
  );
}

function Gone() {
  return (
    <>
      <h1>This job has been removed</h1>
      <p>
        <Link href="/">All jobs</Link>
      </p>
    </>
  );
}
