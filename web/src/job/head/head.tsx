import { useState } from "preact/hooks";
import { Link, useLocation } from "wouter-preact";
import { type Job, api } from "../../api/client";
import { ConfirmButton } from "../../parts/confirm-button";
import { duration, figure, moment } from "../../parts/format";
import { ProblemNotice } from "../../parts/problem-notice";
import { CompareDialog } from "./compare-dialog";
import { RemoveDialog } from "./remove-dialog";

/** Head of a job's view: what it is, how far it is, and what can be done with it. */
export function Head({ job, again }: { job: Job; again: () => void }) {
  return (
    <header class="job-head">
      <h1>
        {job.scenario.title || "Untitled job"} <span class={`status ${job.status}`}>{job.status}</span>
      </h1>
      <p class="quiet facts">
        <span>
          Job <code>{job.id}</code>
        </span>
        <span>accepted {moment(job.created)}</span>
        {job.started && <span>started {moment(job.started)}</span>}
        {job.finished && <span>ended {moment(job.finished)}</span>}
        {job.labels.map((label) => (
          <span key={label} class="label">
            {label}
          </span>
        ))}
      </p>
      {job.status === "accepted" && <p aria-live="polite">It waits for a free worker.</p>}
      {job.status === "running" && <Progress job={job} />}
      <Actions job={job} again={again} />
    </header>
  );
}

function Progress({ job }: { job: Job }) {
  const { fraction, simulated_time_s, eta_s, point_steps_per_s } = job.progress;
  const percent = Math.floor(100 * fraction);
  return (
    <div class="job-progress">
      <progress value={fraction} max={1} aria-label="Progress" />
      <p>
        <strong>{percent} %</strong>, {simulated_time_s.toFixed(3)} s of {figure(job.scenario.duration_s)} s simulated
        {eta_s !== null && `, about ${duration(eta_s)} left`}
        {point_steps_per_s > 0 && `, ${figure(point_steps_per_s, 2)} point-steps/s`}
      </p>
      <p class="hidden" aria-live="polite">
        {`${10 * Math.floor(percent / 10)} % done`}
      </p>
    </div>
  );
}

function Actions({ job, again }: { job: Job; again: () => void }) {
  const [problem, setProblem] = useState<unknown>();
  const [asks, setAsks] = useState<"remove" | "compare">();
  const [, goTo] = useLocation();
  const isLive = job.status === "accepted" || job.status === "running";
  const end = async (query: { remove?: "ended" }, then: () => void) => {
    setProblem(undefined);
    try {
      await api.DELETE("/v1/jobs/{id}", { params: { path: { id: job.id }, query } });
      then();
    } catch (error) {
      setProblem(error);
    }
  };
  return (
    <>
      <div class="actions">
        {isLive && <ConfirmButton label="Dismiss" question="Really stop it?" act={() => void end({}, again)} />}
        <Link href={`/new?job=${job.id}`} class="button">
          Run again with changes
        </Link>
        {job.status === "successful" && (
          <button type="button" onClick={() => setAsks("compare")}>
            Compare with …
          </button>
        )}
        {!isLive && (
          <button type="button" onClick={() => setAsks("remove")}>
            Remove …
          </button>
        )}
      </div>
      {problem ? <ProblemNotice problem={problem} /> : null}
      {asks === "compare" && <CompareDialog id={job.id} close={() => setAsks(undefined)} />}
      {asks === "remove" && (
        <RemoveDialog close={() => setAsks(undefined)} remove={() => void end({ remove: "ended" }, () => goTo("/"))} />
      )}
    </>
  );
}
