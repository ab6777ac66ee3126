import { memo } from "preact/compat";
import { Link } from "wouter-preact";
import { type JobSummary, api, data } from "../api/client";
import { ConfirmButton } from "../parts/confirm-button";
import { duration, figure, moment } from "../parts/format";
import { hasEnded } from "../parts/status";
import { studyOf } from "./filter";

interface RowProps {
  job: JobSummary;
  isChosen: boolean;
  choose: (id: string, isChosen: boolean) => void;
  /** Tells what went wrong; undefined at a new attempt. */
  fail: (problem: unknown) => void;
}

/** A job in the list. */
export const JobRow = memo(function JobRow({ job, isChosen, choose, fail }: RowProps) {
  const title = job.title || "Untitled scenario";
  const study = studyOf(job);
  const labels = study === undefined ? job.labels : [];
  const end = (query: { remove?: "ended" }) => {
    fail(undefined);
    data(api.DELETE("/v1/jobs/{id}", { params: { path: { id: job.id }, query } })).catch(fail);
  };
  return (
    <li class="job-row" data-job={job.id}>
      <input
        type="checkbox"
        aria-label={`Compare ${title}`}
        checked={isChosen}
        disabled={job.status !== "successful"}
        onChange={(event) => choose(job.id, event.currentTarget.checked)}
      />
      <div class="job-title">
        <Link href={`/jobs/${job.id}`}>{title}</Link>
        <span class="quiet">
          {study !== undefined && (
            <>
              member of <Link href={`/studies/${study}`}>a study</Link> ·{" "}
            </>
          )}
          {[...labels, moment(job.created)].join(" · ")}
        </span>
      </div>
      <div class="job-state">
        <span class={`status ${job.status}`}>{job.status}</span>
        <JobProgress job={job} />
      </div>
      <div class="job-actions">
        <Link class="button" href={`/new?job=${job.id}`} aria-label={`Run ${title} again with changes`}>
          Run again
        </Link>
        {hasEnded(job.status) ? (
          <ConfirmButton
            label="Remove"
            question="Really remove it and its results?"
            act={() => end({ remove: "ended" })}
          />
        ) : (
          <ConfirmButton label="Dismiss" question="Really stop it?" act={() => end({})} />
        )}
      </div>
    </li>
  );
});

/** Progress of a running job, and the time that one which has ended took. */
function JobProgress({ job }: { job: JobSummary }) {
  if (job.status === "running") {
    const percent = Math.floor(100 * job.progress.fraction);
    return (
      <>
        <progress value={job.progress.fraction} aria-label="Progress" />
        <span class="quiet">
          {percent} %,{" "}
          {job.progress.eta_s === null ? "time left not known yet" : `about ${duration(job.progress.eta_s)} left`}
        </span>
      </>
    );
  }
  if (job.status === "accepted") return <span class="quiet">waits for a worker</span>;
  if (!job.started || !job.finished) return null;
  const took = (Date.parse(job.finished) - Date.parse(job.started)) / 1000;
  const reached = job.status === "successful" ? "" : `, ${figure(job.progress.simulated_time_s)} s simulated`;
  return <span class="quiet">{`took ${duration(took)}${reached}`}</span>;
}
