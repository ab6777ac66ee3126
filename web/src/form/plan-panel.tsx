import type { Planned, Schemas } from "../api/client";
import { duration, figure, length, size } from "../parts/format";
import { ProblemNotice } from "../parts/problem-notice";
import { sentence } from "../parts/words";
import { useForm } from "./form-context";
import type { PlanState } from "./use-plan";
import { fieldName } from "./words";

/** What the run would compute, leave out and take. */
export function PlanPanel({ plan }: { plan: PlanState }) {
  const { planned, violations, problem, isAsking, waitS } = plan;
  return (
    <section class="plan" aria-labelledby="plan-title" aria-busy={isAsking}>
      <h2 id="plan-title">
        What the run will take{" "}
        <span class="quiet" role="status">
          {isAsking ? "being planned …" : ""}
        </span>
      </h2>
      {waitS !== undefined && (
        <p class="notice warning">The service is busy or does not answer. It is asked again in {waitS} s.</p>
      )}
      {problem !== undefined && <ProblemNotice problem={problem} />}
      {violations.length > 0 && <p>There is no plan as long as fields break the rules.</p>}
      {planned && <PlanOf planned={planned} />}
    </section>
  );
}

function PlanOf({ planned }: { planned: Planned }) {
  const { plan, refinement_runs: runs } = planned;
  const { cost, choices } = plan;
  const taken = choices.filter((choice) => choice.taken);
  const others = choices.filter((choice) => !choice.taken);
  return (
    <>
      <WallTime planned={planned} />
      <p>
        {cost.points === 0
          ? "Bodies alone are computed, without a flow."
          : `The flow is ${cost.points.toLocaleString("en")} material points in cells of ${length(cost.cell_size_m)}, within ${size(cost.memory_bytes)} of memory.`}{" "}
        The run is expected to end at {figure(cost.expected_end_s)} s of simulated time.
      </p>
      {(plan.hints ?? []).map((hint) => (
        <p class="notice warning" key={hint.field + hint.detail}>
          {sentence(hint.detail)} <FieldLink pointer={hint.field} />
        </p>
      ))}
      {taken.length > 0 && (
        <Reductions
          title={`Saved work: ${taken.length} ${taken.length === 1 ? "reduction" : "reductions"}`}
          choices={taken}
        />
      )}
      {others.length > 0 && (
        <Reductions
          title={`Not used: ${others.length} ${others.length === 1 ? "reduction" : "reductions"}`}
          choices={others}
        />
      )}
      {runs.length > 0 && <RefinementRuns runs={runs} />}
      <Numbers planned={planned} />
    </>
  );
}

/** The expected wall time, first in large. */
function WallTime({ planned: { wall_time: time, refinement_runs: runs } }: { planned: Planned }) {
  const [low, high] = [duration(time.low_s), duration(time.high_s)];
  const span = low === high ? low : `${low} to ${high}`;
  const all = runs.length === 0 ? "" : ` for all ${runs.length + 1} runs`;
  return (
    <p class="wall-time">
      {time.expected_s === null ? (
        <>
          <strong>{span}</strong> of computing: the first runs find the cells that the target takes.
        </>
      ) : (
        <>
          <strong>About {duration(time.expected_s)}</strong> of computing{all} ({span}).
        </>
      )}
    </p>
  );
}

function Reductions({ title, choices }: { title: string; choices: Schemas["Choice"][] }) {
  return (
    <details class="more">
      <summary>{title}</summary>
      <ul class="reductions">
        {choices.map(({ what, why, error, taken, decided_by: pointer }) => (
          <li key={what}>
            <strong>{sentence(what)}</strong> {sentence(why)} {taken && <span class="quiet">Error: {error}. </span>}
            {pointer != null && <FieldLink pointer={pointer} />}
          </li>
        ))}
      </ul>
    </details>
  );
}

/** Link to a field: moves the focus there. */
export function FieldLink({ pointer }: { pointer: string }) {
  const { document, schemas, reveal } = useForm();
  return (
    <button type="button" class="link" onClick={() => reveal(pointer)}>
      {fieldName(pointer, document, schemas)}
    </button>
  );
}

function RefinementRuns({ runs }: { runs: Planned["refinement_runs"] }) {
  return (
    <details class="more">
      <summary>
        {runs.length} {runs.length === 1 ? "run" : "runs"} before that of the answer, for its uncertainty
      </summary>
      <div class="scroll" tabIndex={0} role="region" aria-label="Refinement runs">
        <table>
          <thead>
            <tr>
              <th>Purpose</th>
              <th class="number">Cells</th>
              <th class="number">Expected</th>
            </tr>
          </thead>
          <tbody>
            {runs.map((run, index) => (
              <tr key={index}>
                <td>{run.role.replaceAll("_", " ")}</td>
                <td class="number">{length(run.cell_size_m)}</td>
                <td class="number">{duration(run.expected_s)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </details>
  );
}

function Numbers({ planned: { plan, wall_time: time } }: { planned: Planned }) {
  const { cost } = plan;
  const stages = cost.stages.map(
    ({ share, points, expected_substeps: substeps }) =>
      `${share}: ${points.toLocaleString("en")} points, ${substeps.toLocaleString("en")} sub-steps`,
  );
  const rows: [string, string][] = [
    ["Material points", cost.points.toLocaleString("en")],
    ["Cell size", length(cost.cell_size_m)],
    ["Memory", size(cost.memory_bytes)],
    ["Steps (transfers)", cost.steps.toLocaleString("en")],
    ["Acoustic sub-steps", cost.substeps.toLocaleString("en")],
    ["Point-steps", figure(cost.point_steps)],
    ["Sub-steps of the bodies", figure(cost.body_substeps)],
    ["Stages, by share of the flow", stages.join("; ") || "none"],
    ["Solver threads", String(time.threads)],
  ];
  return (
    <details class="more">
      <summary>Numbers</summary>
      <table>
        <tbody>
          {rows.map(([name, value]) => (
            <tr key={name}>
              <th scope="row">{name}</th>
              <td>{value}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </details>
  );
}
