import type { Schemas } from "../api/client";
import { figure } from "../parts/format";
import { unitOfKey } from "../parts/words";
import { ofBody, titled } from "./names";
import { percent } from "./percent";

/** Answer of quantiles: a table. */
export function QuantilesAnswer({
  asked,
  answer,
}: {
  asked: Schemas["QuantilesQuestion"];
  answer: Schemas["Quantile"][];
}) {
  const unit = unitOfKey(asked.quantity);
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label={`Quantiles of ${ofBody(asked.quantity, asked.body)}`}>
      <table>
        <thead>
          <tr>
            <th scope="col" class="number">
              Quantile
            </th>
            <th scope="col" class="number">
              {titled("Value", unit)}
            </th>
            <th scope="col" class="number">
              {titled("95 % interval", unit)}
            </th>
          </tr>
        </thead>
        <tbody>
          {answer.map(({ probability, estimate, lower, upper }) => (
            <tr key={probability}>
              <th scope="row" class="number">
                {percent(probability)}
              </th>
              <td class="number">{figure(estimate, 4)}</td>
              <td class="number">{bounds(lower, upper)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function bounds(lower: number | null | undefined, upper: number | null | undefined): string {
  const [isLow, isHigh] = [lower ?? null, upper ?? null].map((bound) => bound !== null);
  if (!isLow && !isHigh) return "too few members for bounds";
  if (!isLow) return `no lower bound, up to ${figure(upper, 4)}`;
  if (!isHigh) return `from ${figure(lower, 4)}, no upper bound`;
  return `${figure(lower, 4)} to ${figure(upper, 4)}`;
}

/** Answer of a mean, with sampling and numerical error. */
export function MeanAnswer({ quantity, answer }: { quantity: string; answer: Schemas["StudyMean"] }) {
  const { estimate, lower, upper, sampling_error, numerical_error, known, unknown } = answer;
  const unit = unitOfKey(quantity);
  const of = (value: number | null | undefined, digits = 4) => `${figure(value, digits)} ${unit}`.trim();
  if (estimate === null || estimate === undefined) return <p>Too few members for a mean: {known} known.</p>;
  return (
    <>
      <p class="result">
        <strong>{of(estimate)}</strong> ({of(lower)} to {of(upper)}, 95 % interval)
      </p>
      <p>
        Sampling error ±{of(sampling_error, 2)};{" "}
        {numerical_error === null || numerical_error === undefined
          ? "numerical error not known, as the study has one level of cells"
          : `numerical error ±${of(numerical_error, 2)}`}
        . From {known} members{unknown > 0 ? `; ${unknown} more are unknown` : ""}.
      </p>
    </>
  );
}
