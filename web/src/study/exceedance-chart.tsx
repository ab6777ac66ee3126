import { useId, useMemo, useState } from "preact/hooks";
import { figure } from "../parts/format";
import { useWidth } from "../parts/use-width";
import type { Schemas } from "../api/client";
import { type Step, curve, exceeding } from "./exceedance";
import { percent, percentRange } from "./percent";
import { type Range, rangeOf, roundValues } from "./scales";

const HEIGHT = 230;
const [LEFT, RIGHT, TOP, BELOW] = [52, 14, 8, 42];

interface ChartProps {
  title: string;
  unit: string;
  asked: Schemas["Exceedance"][];
  /** Values of the members; none if they are not what the answer is made of. */
  values: number[] | undefined;
  unknown: number;
}

/** Exceedance curve with its band, and the thresholds that were asked for with their intervals. */
export function ExceedanceChart({ title, unit, asked, values, unknown }: ChartProps) {
  const [box, width] = useWidth<HTMLDivElement>();
  const range = useMemo(
    () => rangeOf([...(values ?? []), ...asked.map(({ threshold }) => threshold)], 0.06),
    [values, asked],
  );
  const steps = useMemo(() => (values ? curve(values, unknown) : []), [values, unknown]);
  const field = width - LEFT - RIGHT;
  return (
    <figure class="chart">
      <div ref={box}>
        {field > 40 && (
          <svg
            width={width}
            height={TOP + HEIGHT + BELOW}
            role="img"
            aria-label={`Probability that ${title} exceeds a threshold; the table has the numbers`}
          >
            <g transform={`translate(${LEFT} ${TOP})`}>
              <Axes range={range} width={field} title={unit === "" ? "threshold" : `threshold [${unit}]`} />
              <Curve steps={steps} range={range} width={field} />
              <Asked asked={asked} range={range} width={field} />
            </g>
          </svg>
        )}
      </div>
      {values && values.length > 0 && (
        <Reading title={title} unit={unit} range={range} values={values} unknown={unknown} />
      )}
    </figure>
  );
}

function across(value: number, [from, to]: Range, width: number): number {
  return ((value - from) / (to - from)) * width;
}

function up(share: number): number {
  return (1 - share) * HEIGHT;
}

function Axes({ range, width, title }: { range: Range; width: number; title: string }) {
  return (
    <g class="axes">
      {roundValues([0, 1], 5).map((share) => (
        <g key={share}>
          <line x1={0} x2={width} y1={up(share)} y2={up(share)} />
          <text x={-6} y={up(share) + 4} text-anchor="end">
            {percent(share)}
          </text>
        </g>
      ))}
      {roundValues(range, width / 90).map((value) => (
        <g key={value}>
          <line x1={across(value, range, width)} x2={across(value, range, width)} y1={0} y2={HEIGHT} />
          <text x={across(value, range, width)} y={HEIGHT + 16} text-anchor="middle">
            {figure(value)}
          </text>
        </g>
      ))}
      <text x={width / 2} y={HEIGHT + 36} text-anchor="middle">
        {title}
      </text>
    </g>
  );
}

function Curve({ steps, range, width }: { steps: Step[]; range: Range; width: number }) {
  if (steps.length === 0) return null;
  const ends = steps.map((_, place) => {
    const from = place === 0 ? range[0] : (steps[place]?.threshold ?? range[0]);
    return [across(from, range, width), across(steps[place + 1]?.threshold ?? range[1], range, width)] as const;
  });
  const line = (of: (step: Step) => number) =>
    steps
      .map((step, place) => ends[place]?.map((x) => `${x.toFixed(1)},${up(of(step)).toFixed(1)}`).join("L"))
      .join("L");
  const back = (of: (step: Step) => number) =>
    steps
      .map((step, place) =>
        [...(ends[place] ?? [])]
          .reverse()
          .map((x) => `${x.toFixed(1)},${up(of(step)).toFixed(1)}`)
          .join("L"),
      )
      .reverse()
      .join("L");
  return (
    <>
      <path class="band" d={`M${line(({ upper }) => upper)}L${back(({ lower }) => lower)}Z`} />
      <path class="line" d={`M${line(({ estimate }) => estimate)}`} />
    </>
  );
}

function Asked({ asked, range, width }: { asked: ChartProps["asked"]; range: Range; width: number }) {
  return (
    <g class="asked">
      {asked.map(({ threshold, probability: { estimate, lower, upper } }) => {
        const x = across(threshold, range, width);
        return (
          <g key={threshold}>
            <path d={`M${x - 5},${up(lower)}h10M${x - 5},${up(upper)}h10M${x},${up(lower)}V${up(upper)}`} />
            {estimate !== null && estimate !== undefined && <circle cx={x} cy={up(estimate)} r={4.5} />}
          </g>
        );
      })}
    </g>
  );
}

/** Slider that reads the curve at any threshold. */
function Reading({
  title,
  unit,
  range,
  values,
  unknown,
}: Omit<ChartProps, "asked" | "values"> & { range: Range; values: number[] }) {
  const id = useId();
  const [share, setShare] = useState(50);
  const threshold = range[0] + (share / 100) * (range[1] - range[0]);
  const { estimate, lower, upper } = exceeding(values, unknown, threshold);
  const at = `${figure(threshold)}${unit === "" ? "" : ` ${unit}`}`;
  return (
    <figcaption>
      <label for={id}>Read the curve at another threshold</label>
      <input
        id={id}
        class="wide"
        type="range"
        min="0"
        max="100"
        step="0.5"
        value={share}
        aria-valuetext={at}
        onInput={(event) => setShare(Number(event.currentTarget.value))}
      />
      <output for={id}>
        {title} exceeds {at}: {percent(estimate)} ({percentRange(lower, upper)})
      </output>
    </figcaption>
  );
}
