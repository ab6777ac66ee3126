import { useMemo } from "preact/hooks";
import type { Schemas } from "../api/client";
import { figure } from "../parts/format";
import { unitOfKey } from "../parts/words";
import type { AnswerProps } from "./answer-props";
import { type Probability, valued } from "./documents";
import { ExceedanceChart } from "./exceedance-chart";
import { IntervalBar } from "./interval-bar";
import { MOST_MEMBERS } from "./member-pages";
import { ofBody, titled } from "./names";
import { percent, percentRange, probabilityText } from "./percent";

/** Answer how likely a quantity exceeds thresholds: curve and table. */
export function ExceedsAnswer({
  asked,
  answer,
  members,
  draws,
  hasLevels,
}: AnswerProps & { asked: Schemas["ExceedsQuestion"]; answer: Schemas["Exceedance"][] }) {
  const { quantity, body } = asked;
  const unit = unitOfKey(quantity);
  const values = useMemo(() => valued(draws, quantity, body).map(({ value }) => value), [draws, quantity, body]);
  const { known = 0, unknown = 0 } = answer[0]?.probability ?? {};
  // While a study runs, the members that were read may be ahead of the answer.
  const others = Math.max(0, known + unknown - values.length);
  const isWhole = members.length < MOST_MEMBERS;
  return (
    <>
      <ExceedanceChart
        title={ofBody(quantity, body)}
        unit={unit}
        asked={answer}
        values={!hasLevels && isWhole ? values : undefined}
        unknown={others}
      />
      {!isWhole && <p class="quiet">No curve is drawn, as this page does not read that many members.</p>}
      {hasLevels && (
        <p class="quiet">
          No curve is drawn between the thresholds: the members' own values are those of coarse cells.
        </p>
      )}
      <Thresholds title={ofBody(quantity, body)} unit={unit} answer={answer} />
    </>
  );
}

function Thresholds({ title, unit, answer }: { title: string; unit: string; answer: Schemas["Exceedance"][] }) {
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label={`Thresholds of ${title}`}>
      <table>
        <thead>
          <tr>
            <th scope="col" class="number">
              {titled("Threshold", unit)}
            </th>
            <th scope="col" class="number">
              Probability
            </th>
            <th scope="col" class="number">
              95 % interval
            </th>
            <th scope="col" class="number">
              Members above
            </th>
          </tr>
        </thead>
        <tbody>
          {answer.map(({ threshold, probability }) => (
            <tr key={threshold}>
              <th scope="row" class="number">
                {figure(threshold, 4)}
              </th>
              <td class="number">{percent(probability.estimate)}</td>
              <td class="number">{percentRange(probability.lower, probability.upper)}</td>
              <td class="number">{counts(probability)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

/** Answer how likely a body ends below the surface. */
export function BuriedAnswer({ answer }: { answer: Probability }) {
  return (
    <p class="result">
      <strong>{probabilityText(answer)}</strong> <IntervalBar {...answer} estimate={answer.estimate} /> {counts(answer)}{" "}
      members; 95 % interval.
    </p>
  );
}

function counts({ happened, known, unknown }: Probability): string {
  return `${happened} of ${known}${unknown > 0 ? `, ${unknown} unknown` : ""}`;
}
