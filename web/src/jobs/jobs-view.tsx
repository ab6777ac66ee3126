/** View of the jobs. */

import { useCallback, useEffect, useRef, useState } from "preact/hooks";
import { Link } from "wouter-preact";
import { onTokenChange } from "../api/token";
import { onServiceEvent } from "../events/events";
import { ProblemNotice } from "../parts/problem-notice";
import { useTitle } from "../parts/use-title";
import { ALL, type Filter } from "./filter";
import { FilterForm } from "./filter-form";
import { JobList, type ListState } from "./job-list";
import { JobRow } from "./job-row";
import "./jobs.css";

export function JobsView() {
  useTitle("Jobs");
  const [filter, setFilter] = useState<Filter>(ALL);
  const [state, more] = useJobList(filter);
  const [chosen, setChosen] = useState<string[]>([]);
  const [problem, setProblem] = useState<unknown>();
  const choose = useCallback((id: string, isChosen: boolean) => {
    // The two chosen last.
    setChosen((chosen) => [...chosen.filter((other) => other !== id), ...(isChosen ? [id] : [])].slice(-2));
  }, []);
  return (
    <>
      <h1>Jobs</h1>
      <p>
        A job computes where an object hit by a granular flow ends up. <Link href="/new">Set up a new scenario</Link>.
      </p>
      <FilterForm filter={filter} change={setFilter} />
      {(problem ?? state?.problem) !== undefined && <ProblemNotice problem={problem ?? state?.problem} />}
      <div class="actions">
        <CompareLink chosen={chosen} />
        <span class="quiet" role="status">
          {state && counted(state)}
        </span>
      </div>
      {state && <List state={state} chosen={chosen} choose={choose} fail={setProblem} isFiltered={filter !== ALL} />}
      {state?.hasMore && <More read={more} isEager={state.problem === undefined} />}
    </>
  );
}

/** List of a filter, and the means to read more of it. */
function useJobList(filter: Filter): [ListState | undefined, () => void] {
  const [state, setState] = useState<ListState>();
  const [round, setRound] = useState(0);
  const list = useRef<JobList>();
  useEffect(() => onTokenChange(() => setRound((round) => round + 1)), []);
  useEffect(() => {
    const current = new JobList(filter, setState);
    list.current = current;
    const leave = onServiceEvent((event) => current.take(event));
    return () => {
      leave();
      current.close();
    };
  }, [filter, round]);
  const more = useCallback(() => {
    if (list.current && !list.current.state.isReading) void list.current.readMore();
  }, []);
  return [state, more];
}

function counted(state: ListState): string {
  const count = state.jobs.length;
  if (count === 0) return "";
  return `${state.hasMore ? "The newest " : ""}${count} ${count === 1 ? "job" : "jobs"}`;
}

function CompareLink({ chosen }: { chosen: string[] }) {
  const [one, other] = chosen;
  if (one === undefined || other === undefined) {
    return <span class="quiet">Tick two successful jobs to compare them.</span>;
  }
  return (
    <Link class="button primary" href={`/compare/${one}/${other}`}>
      Compare the two jobs
    </Link>
  );
}

interface ListProps {
  state: ListState;
  chosen: string[];
  choose: (id: string, isChosen: boolean) => void;
  fail: (problem: unknown) => void;
  isFiltered: boolean;
}

function List({ state, chosen, choose, fail, isFiltered }: ListProps) {
  if (state.jobs.length === 0) {
    if (state.isReading || state.problem !== undefined) return null;
    return (
      <p class="card">
        {isFiltered ? "No job is like that. " : "There are no jobs yet. "}
        <Link href="/new">Begin with one of the examples</Link>, or send a scenario by <a href="docs">the interface</a>.
      </p>
    );
  }
  return (
    <ul class="jobs">
      {state.jobs.map((job) => (
        <JobRow key={job.id} job={job} isChosen={chosen.includes(job.id)} choose={choose} fail={fail} />
      ))}
    </ul>
  );
}

/** End of the list: reads more as soon as it is seen, unless that has just failed, or by its button. */
function More({ read, isEager }: { read: () => void; isEager: boolean }) {
  const end = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!isEager) return;
    const seen = new IntersectionObserver(([entry]) => entry?.isIntersecting && read(), { rootMargin: "600px" });
    if (end.current) seen.observe(end.current);
    return () => seen.disconnect();
  });
  return (
    <div ref={end} class="actions">
      <button type="button" onClick={read}>
        Show older jobs
      </button>
    </div>
  );
}
