import { useState } from "preact/hooks";
import type { Job, Outcome } from "../../api/client";
import { figure } from "../../parts/format";
import { type Ground, groundOf } from "../../scenario/ground";
import { type Quantity, bodyQuantities, flowQuantities, intervalText, overlap } from "../outcome/quantities";

/** Rows of a comparison: bodies that both jobs have, and the flow. */
interface Group {
  name: string;
  rows: [Quantity, Quantity][];
}

/** Bodies shown before "Show all". */
const BODIES_AT_FIRST = 3;

/** A job with its outcome. */
export type Finished = Pick<Job, "scenario"> & { outcome: Outcome };

/** Outcomes of two jobs beside each other. */
export function OutcomeComparison({ first, second }: { first: Finished; second: Finished }) {
  const [isWhole, setIsWhole] = useState(false);
  const ground = groundOf(first.scenario);
  const groups = groupsOf(first.outcome, second.outcome, ground);
  const bodies = groups.filter(({ name }) => name !== FLOW);
  const shownGroups = isWhole ? groups : [...bodies.slice(0, BODIES_AT_FIRST), ...groups.slice(bodies.length)];
  const hasIntervals = groups.some(({ rows }) => rows.some(([a, b]) => a.interval && b.interval));
  return (
    <section aria-labelledby="outcomes">
      <h2 id="outcomes">Outcomes</h2>
      {ground !== groundOf(second.scenario) && (
        <p class="notice">
          One job is in a channel, the other on a terrain: positions and fronts are measured from different places.
        </p>
      )}
      {first.outcome.bodies.length !== second.outcome.bodies.length && (
        <p class="notice">
          The first job has {first.outcome.bodies.length} bodies, the second {second.outcome.bodies.length}; those with
          the same number are compared.
        </p>
      )}
      {groups.length === 0 && <p>The jobs have neither a body nor a flow in common.</p>}
      {shownGroups.map((group) => (
        <GroupTable key={group.name} {...group} hasIntervals={hasIntervals} />
      ))}
      {bodies.length > BODIES_AT_FIRST && (
        <button type="button" aria-expanded={isWhole} onClick={() => setIsWhole(!isWhole)}>
          {isWhole ? `Show the first ${BODIES_AT_FIRST} bodies` : `Show all ${bodies.length} bodies`}
        </button>
      )}
      {!hasIntervals && groups.length > 0 && (
        <p class="quiet">
          Not both jobs have uncertainty intervals, so nothing tells whether a difference is more than the error of the
          cells.
        </p>
      )}
    </section>
  );
}

const FLOW = "Flow";

function groupsOf(first: Outcome, second: Outcome, ground: Ground): Group[] {
  const groups = first.bodies.flatMap((body, place): Group[] => {
    const other = second.bodies[place];
    return other
      ? [{ name: `Body ${place}`, rows: paired(bodyQuantities(body, ground), bodyQuantities(other, ground)) }]
      : [];
  });
  const flow = paired(flowQuantities(first, ground), flowQuantities(second, ground));
  return flow.length > 0 ? [...groups, { name: FLOW, rows: flow }] : groups;
}

function paired(first: Quantity[], second: Quantity[]): [Quantity, Quantity][] {
  return first.flatMap((quantity): [Quantity, Quantity][] => {
    const other = second.find(({ key }) => key === quantity.key);
    return other ? [[quantity, other]] : [];
  });
}

function GroupTable({ name, rows, hasIntervals }: Group & { hasIntervals: boolean }) {
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label={`Comparison: ${name}`}>
      <table class="comparison">
        <caption>{name}</caption>
        <thead>
          <tr>
            <th>Quantity</th>
            <th class="number">First</th>
            <th class="number">Second</th>
            <th class="number">Difference</th>
            <th class="number">of the first</th>
            {hasIntervals && <th>Intervals</th>}
          </tr>
        </thead>
        <tbody>
          {rows.map(([a, b]) => (
            <tr key={a.key}>
              <th scope="row">
                {a.name} <span class="unit">[{a.unit}]</span>
              </th>
              <td class="number">{shown(a)}</td>
              <td class="number">{shown(b)}</td>
              <td class="number">{differenceText(a, b)}</td>
              <td class="number">{shareText(a, b)}</td>
              {hasIntervals && <td>{overlapText(a, b)}</td>}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function shown({ value, digits, interval }: Quantity) {
  return (
    <>
      {value === null ? "did not happen" : figure(value, digits)}
      {interval && <span class="ends">{intervalText(interval, digits)}</span>}
    </>
  );
}

/** Difference of two values with its sign; empty if either did not happen. */
export function differenceText({ value: a }: Quantity, { value: b }: Quantity): string {
  if (a === null || b === null) return "";
  return `${b > a ? "+" : ""}${figure(b - a)}`;
}

/** Difference over the first value in per cent; empty where that says nothing. */
export function shareText({ value: a }: Quantity, { value: b }: Quantity): string {
  if (a === null || b === null || a === 0) return "";
  const percent = (100 * (b - a)) / Math.abs(a);
  return `${percent > 0 ? "+" : ""}${figure(percent, 2)} %`;
}

function overlapText(a: Quantity, b: Quantity): string {
  const is = overlap(a.interval, b.interval);
  if (is === undefined) return "";
  return is ? "overlap" : "apart: more than the cells explain";
}
