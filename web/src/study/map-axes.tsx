import { figure } from "../parts/format";
import type { Ground } from "../scenario/ground";
import type { ChannelOutline } from "./map-frame";
import { type MapScale, onMap, roundValues } from "./scales";

/** Digits of a number on an axis: a terrain is large beside what happens on it. */
const DIGITS = 6;

/** Titles of the axes. */
const TITLES: Record<Ground, [x: string, y: string]> = {
  channel: ["x downstream [m]", "y across [m]"],
  terrain: ["x east [m]", "y north [m]"],
};

/** Round values along both axes of a map, with lines. */
export function MapAxes({ scale, ground }: { scale: MapScale; ground: Ground }) {
  const { x, y, width, height } = scale;
  return (
    <g class="axes">
      {roundValues(x, width / 90).map((value) => {
        const [left] = onMap(scale, [value, 0]);
        return (
          <g key={`x${value}`}>
            <line x1={left} x2={left} y1={0} y2={height} />
            <text x={left} y={height + 15} text-anchor="middle">
              {figure(value, DIGITS)}
            </text>
          </g>
        );
      })}
      {roundValues(y, height / 50).map((value) => {
        const [, top] = onMap(scale, [0, value]);
        return (
          <g key={`y${value}`}>
            <line x1={0} x2={width} y1={top} y2={top} />
            <text x={-6} y={top + 4} text-anchor="end">
              {figure(value, DIGITS)}
            </text>
          </g>
        );
      })}
      <rect x={0} y={0} width={width} height={height} />
      <text x={width / 2} y={height + 33} text-anchor="middle">
        {TITLES[ground][0]}
      </text>
      <text transform={`translate(-40 ${height / 2}) rotate(-90)`} text-anchor="middle">
        {TITLES[ground][1]}
      </text>
    </g>
  );
}

/** Side walls, foot of the incline and ends of a channel. */
export function MapChannel({ channel, scale }: { channel: ChannelOutline; scale: MapScale }) {
  const { halfWidth, ends, hasFoot } = channel;
  const [left, right] = [Math.max(ends[0], scale.x[0]), Math.min(ends[1], scale.x[1])];
  const across = (x: number, name: string) =>
    x >= scale.x[0] && x <= scale.x[1] ? (
      <Line scale={scale} from={[x, -halfWidth]} to={[x, halfWidth]} name={name} />
    ) : null;
  return (
    <g class="ground">
      <Line scale={scale} from={[left, halfWidth]} to={[right, halfWidth]} name="wall" />
      <Line scale={scale} from={[left, -halfWidth]} to={[right, -halfWidth]} name="wall" />
      {across(ends[0], "wall")}
      {across(ends[1], "end")}
      {hasFoot && across(0, "foot")}
    </g>
  );
}

function Line({
  scale,
  from,
  to,
  name,
}: {
  scale: MapScale;
  from: [number, number];
  to: [number, number];
  name: string;
}) {
  const [[x1, y1], [x2, y2]] = [onMap(scale, from), onMap(scale, to)];
  return <line class={name} x1={x1} y1={y1} x2={x2} y2={y2} />;
}

/** The body's place at the start [px]. */
export function Start({ at: [x, y] }: { at: [number, number] }) {
  return <path class="start" d={`M${x - 7},${y}h14M${x},${y - 7}v14`} />;
}
