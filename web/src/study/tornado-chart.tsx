import { useMemo } from "preact/hooks";
import { figure } from "../parts/format";
import { unitOfKey } from "../parts/words";
import type { AnswerProps } from "./answer-props";
import type { SensitivityMeasures } from "./documents";
import { ofBody, placeName, titled } from "./names";
import { roundValues } from "./scales";
import { type Bar, type Direction, type Row, directions, tornado } from "./sensitivity";

/** Size of the bars [px]. */
const WIDTH = 260;
const ROW = 14;

const WORDS: Record<Direction, string> = {
  rises: "↗ rises with it",
  falls: "↘ falls with it",
  unclear: "no clear direction",
};

/** Answer which inputs a quantity depends on: a tornado whose rows have their numbers beside the bars. */
export function TornadoChart({
  asked,
  measures,
  study,
  draws,
}: AnswerProps & {
  asked: { quantity: string; body?: number | null };
  measures: SensitivityMeasures | null | undefined;
}) {
  const { quantity, body } = asked;
  const chart = useMemo(
    () => (measures ? tornado(measures, directions(draws, study.inputs.length, quantity, body)) : undefined),
    [measures, draws, study, quantity, body],
  );
  if (!chart) return <p>The quantity does not vary, or too few members have it.</p>;
  const most = Math.max(
    ...chart.rows.flatMap(({ bars }) => bars.map(({ value, upper }) => Math.max(value, upper))),
    1e-12,
  );
  const scale = chart.axis === "share" ? Math.max(1, most) : 1.05 * most;
  const unit =
    chart.axis === "share" ? "share of the variance" : titled("change over the input's range", unitOfKey(quantity));
  return (
    <>
      <Legend bars={chart.bars} />
      <div class="scroll" tabIndex={0} role="region" aria-label={`What ${ofBody(quantity, body)} depends on`}>
        <table class="tornado">
          <Head bars={chart.bars} unit={unit} scale={scale} />
          <tbody>
            {chart.rows.map((row) => (
              <InputRow
                key={row.input}
                row={row}
                name={placeName(study.inputs[row.input]?.pointer ?? "")}
                scale={scale}
              />
            ))}
          </tbody>
        </table>
      </div>
      <p class="quiet">
        {chart.basis} {chart.axis === "share" ? "Lines are 95 % intervals." : "Lines are standard errors."}
      </p>
    </>
  );
}

function Legend({ bars }: { bars: string[] }) {
  return (
    <ul class="legend">
      {bars.map((name, place) => (
        <li key={name}>
          <svg width="14" height="12" aria-hidden="true">
            <rect class={`bar bar-${bars.length - 1 - place}`} width="14" height="12" />
          </svg>{" "}
          {name}
        </li>
      ))}
    </ul>
  );
}

function Head({ bars, unit, scale }: { bars: string[]; unit: string; scale: number }) {
  return (
    <thead>
      <tr>
        <th scope="col">Input</th>
        <th scope="col">
          <span class="hidden">Bars: </span>
          {unit}
          <Ruler scale={scale} />
        </th>
        {bars.map((name) => (
          <th key={name} scope="col" class="number">
            {name}
          </th>
        ))}
        <th scope="col">The quantity</th>
      </tr>
    </thead>
  );
}

function Ruler({ scale }: { scale: number }) {
  return (
    <svg class="ruler" width={WIDTH} height="18" aria-hidden="true">
      {roundValues([0, scale], 3).map((value) => {
        const x = (value / scale) * WIDTH;
        // Numbers at the ends stay within the picture.
        const anchor = x < 10 ? "start" : x > WIDTH - 10 ? "end" : "middle";
        return (
          <text key={value} x={x} y="14" text-anchor={anchor}>
            {figure(value, 2)}
          </text>
        );
      })}
    </svg>
  );
}

function InputRow({ row, name, scale }: { row: Row; name: string; scale: number }) {
  return (
    <tr>
      <th scope="row">{name}</th>
      <td>
        <Bars row={row} scale={scale} />
      </td>
      {row.bars.map((bar, place) => (
        <td key={place} class="number">
          {barText(bar)}
        </td>
      ))}
      <td class={`direction ${row.direction}`}>{WORDS[row.direction]}</td>
    </tr>
  );
}

function Bars({ row: { bars, direction }, scale }: { row: Row; scale: number }) {
  const x = (value: number) => (Math.min(Math.max(value, 0), scale) / scale) * WIDTH;
  return (
    <svg class={`bars ${direction}`} width={WIDTH} height={ROW * bars.length + 2} aria-hidden="true">
      <line class="axis" x1="0.5" x2="0.5" y1="0" y2={ROW * bars.length + 2} />
      {bars.map(({ value, lower, upper }, place) => {
        const middle = ROW * (bars.length - 1 - place) + ROW / 2 + 1;
        return (
          <g key={place}>
            <rect class={`bar bar-${bars.length - 1 - place}`} x="0" y={middle - 5} width={x(value)} height="10" />
            <path
              class="whisker"
              d={`M${x(lower)},${middle}H${x(upper)}M${x(lower)},${middle - 3}v6M${x(upper)},${middle - 3}v6`}
            />
          </g>
        );
      })}
    </svg>
  );
}

function barText({ value, lower, upper }: Bar): string {
  return `${figure(value, 2)} (${figure(lower, 2)} to ${figure(upper, 2)})`;
}
