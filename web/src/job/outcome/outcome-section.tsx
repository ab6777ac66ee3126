import { useState } from "preact/hooks";
import type { Job, Outcome } from "../../api/client";
import { figure, length } from "../../parts/format";
import { sentence } from "../../parts/words";
import type { Ground } from "../../scenario/ground";
import { auditOf, verdictOf } from "./audit";
import { BASIS, type Quantity, bodyQuantities, flowQuantities, intervalText } from "./quantities";
import { sentencesOf } from "./sentences";

/** What happened, in sentences. */
export function Story({ job, submergence }: { job: Job; submergence: readonly number[] }) {
  const warnings = job.outcome?.remarks.filter((remark) => /duration/.test(remark)) ?? [];
  const early = job.outcome?.ended_early;
  return (
    <section aria-labelledby="story">
      <h2 id="story">What happened</h2>
      {sentencesOf(job, submergence).map((text) => (
        <p key={text}>{text}</p>
      ))}
      {early && (
        <p class="quiet">
          The run ended at {figure(early.time_s)} s, since {early.reason}; the rest could have moved a body by no more
          than {length(early.body_bound_m, 2)}
          {early.front_bound_m !== null && ` and the front by no more than ${length(early.front_bound_m, 2)}`}.
        </p>
      )}
      {warnings.map((warning) => (
        <p key={warning} class="notice warning">
          {sentence(warning)}
        </p>
      ))}
    </section>
  );
}

/** Rows shown before "Show all": those of so many bodies. */
const BODIES_AT_FIRST = 3;

/** All quantities of the outcome, with their uncertainty intervals. */
export function Quantities({ outcome, ground }: { outcome: Outcome; ground: Ground }) {
  const [isWhole, setIsWhole] = useState(false);
  const bodies = outcome.bodies.map((body, place) => ({
    name: `Body ${place}`,
    quantities: bodyQuantities(body, ground),
  }));
  const flow = flowQuantities(outcome, ground);
  const groups = [
    ...(isWhole ? bodies : bodies.slice(0, BODIES_AT_FIRST)),
    ...(flow.length > 0 ? [{ name: "Flow", quantities: flow }] : []),
  ];
  const hasIntervals = groups.some(({ quantities }) => quantities.some(({ interval }) => interval));
  return (
    <section aria-labelledby="numbers">
      <h2 id="numbers">The numbers</h2>
      {groups.length === 0 && <p>There is neither a body nor a flow.</p>}
      <div class="quantities">
        {groups.map((group) => (
          <QuantityTable key={group.name} {...group} hasIntervals={hasIntervals} />
        ))}
      </div>
      {bodies.length > BODIES_AT_FIRST && (
        <button type="button" aria-expanded={isWhole} onClick={() => setIsWhole(!isWhole)}>
          {isWhole ? `Show the first ${BODIES_AT_FIRST} bodies` : `Show all ${bodies.length} bodies`}
        </button>
      )}
      {ground === "terrain" && bodies.length > 0 && (
        <p class="quiet">
          Positions are local: east and north of the south-western corner of the height map, and up from a whole number
          of metres below its lowest place.
        </p>
      )}
      {!hasIntervals && groups.length > 0 && (
        <p class="quiet">
          These numbers have no uncertainty intervals. <code>accuracy.error_bars</code> in the scenario asks for them.
        </p>
      )}
      {outcome.accuracy && <AccuracyNote report={outcome.accuracy} />}
    </section>
  );
}

function QuantityTable({
  name,
  quantities,
  hasIntervals,
}: {
  name: string;
  quantities: Quantity[];
  hasIntervals: boolean;
}) {
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label={`Quantities: ${name}`}>
      <table>
        <caption>{name}</caption>
        <thead>
          <tr>
            <th>Quantity</th>
            <th class="number">Value</th>
            <th>Unit</th>
            {hasIntervals && <th>Interval</th>}
          </tr>
        </thead>
        <tbody>
          {quantities.map(({ key, name, unit, value, digits, interval }) => (
            <tr key={key}>
              <th scope="row">{name}</th>
              <td class="number">{value === null ? "did not happen" : figure(value, digits)}</td>
              <td>{unit}</td>
              {hasIntervals && (
                <td class="interval" title={interval ? BASIS[interval.basis] : undefined}>
                  {intervalText(interval, digits)}
                  {interval && <span class="quiet"> {BASIS[interval.basis]}</span>}
                </td>
              )}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function AccuracyNote({ report }: { report: NonNullable<Outcome["accuracy"]> }) {
  const { target, runs } = report;
  return (
    <>
      {target && (
        <p class={target.met ? "notice" : "notice warning"}>
          {target.met ? "The target was met: " : "The target was not met: "}
          {target.quantity} to ±{figure(100 * target.asked)} % was asked for
          {target.reached !== null && `, and ±${figure(100 * target.reached)} % was reached`}
          {target.reason && `; ${target.reason}`}.
        </p>
      )}
      <p class="quiet">
        An interval holds what cells and softened grains change, not what the model leaves out. Behind the intervals are{" "}
        {runs.length} runs, with cells of {runs.map((run) => length(run.cell_size_m)).join(", ")}.
      </p>
    </>
  );
}

/** The conservation audit. */
export function Audit({ outcome, ground }: { outcome: Outcome; ground: Ground }) {
  const figures = auditOf(outcome, ground);
  return (
    <section aria-labelledby="trust">
      <h2 id="trust">May I trust it?</h2>
      <p>
        <strong>{verdictOf(figures)}</strong> The audit says that the equations were solved, not that they are the right
        ones.
      </p>
      <div class="scroll" tabIndex={0} role="region" aria-label="Conservation audit">
        <table class="audit">
          <thead>
            <tr>
              <th>Figure</th>
              <th class="number">Size</th>
              <th>Verdict</th>
              <th>Meaning</th>
            </tr>
          </thead>
          <tbody>
            {figures.map(({ name, meaning, size, isFine, bound }) => (
              <tr key={name}>
                <th scope="row">{name}</th>
                <td class="number">{size}</td>
                <td class={isFine === undefined ? "quiet" : isFine ? "fine" : "doubt"}>
                  {isFine === undefined ? "no bound" : isFine ? "fine" : "look closer"}
                  {bound && <span class="quiet"> ({bound})</span>}
                </td>
                <td>{meaning}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}
