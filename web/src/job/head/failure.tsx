import { Link } from "wouter-preact";
import type { Job } from "../../api/client";
import { sentence } from "../../parts/words";

/** What to do about each kind of failure. */
const HINTS: Record<string, string> = {
  numerical:
    "The numbers of the computation went astray, and a repetition would fail again. Stiffer contacts (contact_modulus_pa), a higher sound speed or smaller cells help most often; so does a start without bodies that fall or fly into each other fast.",
  setup:
    "The service accepted the scenario, but the solver could not set it up. Larger cells take fewer points; a reduction that was asked for by name may not suit the scene.",
  memory: "Larger cells (cell_size_m) need less memory: twice the size takes an eighth of the points.",
  "wall-time":
    "Larger cells, a shorter duration or a softer material (lower sound speed) take less time. What had been computed until then is kept below.",
  "results-size":
    "Fewer samples (a longer sample_interval_s) or fewer snapshots of the flow (flow_snapshots) make smaller results.",
  internal: "This is a fault of the service. Its operator finds the details in the log under the error's identifier.",
  infrastructure:
    "The scenario is not the cause. The service lacked something of its machine: disk, memory or the database. Try again later, or ask its operator.",
  "cut-off":
    "The service died each time it ran this job, perhaps for lack of memory. Larger cells may help; its operator finds more in the log.",
};

/** Reason of a failure, and what to do about it. */
export function FailureNotice({ problem, id }: { problem: NonNullable<Job["problem"]>; id: string }) {
  const kind = problem.type.split(":").pop() ?? "";
  const numbers = Object.entries(problem).filter(([key]) => !["type", "title", "detail"].includes(key));
  return (
    <section class="notice problem" aria-labelledby="failure">
      <h2 id="failure">{problem.title}</h2>
      <p>{sentence(problem.detail)}</p>
      {HINTS[kind] && <p>{HINTS[kind]}</p>}
      {numbers.length > 0 && (
        <dl class="facts">
          {numbers.map(([key, value]) => (
            <div key={key}>
              <dt>
                <code>{key}</code>
              </dt>
              <dd>{String(value)}</dd>
            </div>
          ))}
        </dl>
      )}
      <p>
        <Link href={`/new?job=${id}`}>Change the scenario and run it again</Link>
      </p>
    </section>
  );
}
