import { duration, figure, size } from "../parts/format";
import { ProblemNotice } from "../parts/problem-notice";
import { ServiceProblem } from "../api/problem";
import { lowerBound, upperBound } from "./binomial";
import { percent, percentRange } from "./percent";
import type { CheckedStudy, PlannedStudy } from "./use-study-plan";

/** What the service says about a study that is being written. */
export function PlanNotice({ checked, onPointer }: { checked: CheckedStudy; onPointer: (pointer: string) => void }) {
  const { isChecking, plan, fault, problem } = checked;
  const violations = problem instanceof ServiceProblem ? problem.violations : [];
  return (
    <div class="plan" aria-live="polite" aria-busy={isChecking}>
      {isChecking && <p class="quiet">Checking …</p>}
      {fault && (
        <div class="notice problem">
          <strong>This is not JSON yet</strong>
          <p>{fault}</p>
        </div>
      )}
      {violations.length > 0 && (
        <div class="notice problem">
          <strong>{violations.length === 1 ? "One rule is broken" : `${violations.length} rules are broken`}</strong>
          <ul>
            {violations.map(({ pointer, detail }) => (
              <li key={`${pointer} ${detail}`}>
                {pointer && (
                  <button type="button" class="pointer" onClick={() => onPointer(pointer)}>
                    {pointer}
                  </button>
                )}{" "}
                {detail}
              </li>
            ))}
          </ul>
        </div>
      )}
      {problem !== undefined && violations.length === 0 && <ProblemNotice problem={problem} />}
      {plan && !fault && <Plan plan={plan} />}
    </div>
  );
}

function Plan({ plan: { cost, wall_time } }: { plan: PlannedStudy }) {
  const { members, max_members, accuracy } = cost;
  const likely = wall_time.expected_s === null ? "" : `${duration(wall_time.expected_s)}, likely `;
  return (
    <div class="notice">
      <strong>Allowed. Nothing is stored yet.</strong>
      <dl class="facts">
        <dt>Members</dt>
        <dd>
          {members}
          {max_members > members && `, at most ${max_members}`}
        </dd>
        <dt>Wall time</dt>
        <dd>
          {likely}
          {duration(wall_time.low_s)} to {duration(wall_time.high_s)}, if the service has nothing else to do
        </dd>
        <dt>Work</dt>
        <dd>
          {figure(cost.point_steps)} point-steps, {figure(cost.point_steps_per_member)} for a member
        </dd>
        <dt>Memory</dt>
        <dd>up to {size(cost.member_memory_bytes)} for a member</dd>
        <dt>Certainty</dt>
        <dd>
          with {members} independent members a probability of 50 % is known to {range(0.5, members)}, one of 5 % to{" "}
          {range(0.05, members)} (95 % intervals)
        </dd>
        {accuracy && (
          <>
            <dt>Levels</dt>
            <dd>
              {accuracy.levels
                .map(({ cell_size_m, members }) => `${members} members in cells of ${figure(cell_size_m)} m`)
                .join("; ")}
              : {figure(accuracy.point_steps)} point-steps, {figure(accuracy.gain, 2)} times cheaper than one level. The
              target is{" "}
              {accuracy.is_expected_to_be_met ? "expected to be met" : "not expected to be met within the limits"}.
            </dd>
          </>
        )}
      </dl>
    </div>
  );
}

function range(share: number, members: number): string {
  const happened = Math.round(share * members);
  return members < 1 ? percent(undefined) : percentRange(lowerBound(happened, members), upperBound(happened, members));
}
