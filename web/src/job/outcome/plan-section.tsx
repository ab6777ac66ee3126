import type { Job, Schemas } from "../../api/client";
import { duration, figure, length } from "../../parts/format";

/** What was decided before the run, what the run cost, and where the answer comes from. */
export function PlanAndCost({ job }: { job: Job }) {
  return (
    <section aria-labelledby="plan">
      <h2 id="plan">How it was computed</h2>
      {job.plan && <Choices plan={job.plan} />}
      <div class="columns">
        {job.outcome && <Cost cost={job.outcome.cost} />}
        <Provenance job={job} />
      </div>
    </section>
  );
}

function Choices({ plan }: { plan: Schemas["Plan"] }) {
  return (
    <>
      {plan.hints?.map(({ field, detail }) => (
        <p key={field} class="notice warning">
          <code>{field}</code> {detail}
        </p>
      ))}
      <div class="scroll" tabIndex={0} role="region" aria-label="Reductions">
        <table class="choices">
          <thead>
            <tr>
              <th>Reduction</th>
              <th>Made</th>
              <th>Why</th>
              <th>Error</th>
            </tr>
          </thead>
          <tbody>
            {plan.choices.map(({ what, taken, why, error }) => (
              <tr key={what}>
                <th scope="row">{what}</th>
                <td>{taken ? "yes" : "no"}</td>
                <td>{why}</td>
                <td>{taken ? error : ""}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </>
  );
}

function Cost({ cost }: { cost: Schemas["Cost"] }) {
  return (
    <Facts
      title="Cost"
      facts={[
        ["Wall time", duration(cost.wall_s)],
        ["Point-steps", `${figure(cost.point_steps)} (${figure(cost.point_steps_per_s)} per second)`],
        ["Material points", String(cost.points)],
        ["Cells", length(cost.cell_size_m)],
        ["Steps, sub-steps", `${cost.steps}, ${cost.substeps}`],
        ["Speed of sound", cost.sound_speed_m_s === null ? "–" : `${figure(cost.sound_speed_m_s)} m/s`],
        ["Threads", String(cost.threads)],
      ]}
    />
  );
}

function Provenance({ job }: { job: Job }) {
  const { provenance } = job;
  return (
    <Facts
      title="Provenance"
      facts={[
        ["Version", provenance.solver_version],
        ["Commit", provenance.solver_commit ?? "–"],
        ["Instruction set", provenance.instructions ?? "–"],
        ["Fingerprint of the records", provenance.fingerprint ?? "–"],
        ["Hash of the scenario", provenance.scenario_hash],
        ["Attempts", String(job.attempt)],
      ]}
    />
  );
}

function Facts({ title, facts }: { title: string; facts: [string, string][] }) {
  return (
    <div class="card">
      <h3>{title}</h3>
      <dl class="facts">
        {facts.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
    </div>
  );
}
