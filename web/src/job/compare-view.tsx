import "./job.css";
import { Link } from "wouter-preact";
import { type Job, api, data } from "../api/client";
import { ProblemNotice } from "../parts/problem-notice";
import { useAnswer } from "../parts/use-answer";
import { useTitle } from "../parts/use-title";
import { OutcomeComparison } from "./compare/outcome-comparison";
import { PicturesComparison } from "./compare/pictures-comparison";
import { ScenarioComparison } from "./compare/scenario-comparison";

/** View of two jobs side by side. */
export function CompareView({ ids: [one, other] }: { ids: [string, string] }) {
  const { value, problem } = useAnswer(
    (signal) => Promise.all([one, other].map((id) => read(id, signal))),
    [one, other],
  );
  const [first, second] = value ?? [];
  useTitle("Two jobs compared");
  return (
    <article class="compare">
      <h1>Two jobs compared</h1>
      {problem ? <ProblemNotice problem={problem} /> : null}
      {!value && !problem ? <p class="quiet">Reading the jobs …</p> : null}
      {first && second && <Comparison first={first} second={second} />}
    </article>
  );
}

function read(id: string, signal: AbortSignal): Promise<Job> {
  return data<Job>(api.GET("/v1/jobs/{id}", { params: { path: { id } }, signal }));
}

function Comparison({ first, second }: { first: Job; second: Job }) {
  return (
    <>
      <ul class="compared-jobs">
        {[first, second].map((job, place) => (
          <li key={`${place} ${job.id}`}>
            {place === 0 ? "First" : "Second"}: <Link href={`/jobs/${job.id}`}>{job.scenario.title || "Untitled"}</Link>{" "}
            <span class={`status ${job.status}`}>{job.status}</span> <code>{job.id}</code>
          </li>
        ))}
      </ul>
      <ScenarioComparison first={first.scenario} second={second.scenario} />
      {first.outcome && second.outcome ? (
        <OutcomeComparison
          first={{ ...first, outcome: first.outcome }}
          second={{ ...second, outcome: second.outcome }}
        />
      ) : (
        <p class="notice warning">Outcomes are compared once both jobs are successful.</p>
      )}
      <PicturesComparison first={first} second={second} />
    </>
  );
}
