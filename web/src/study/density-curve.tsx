import { figure } from "../parts/format";
import { type Distribution } from "./documents";
import { type Shape, shape } from "./distributions";
import { rangeOf } from "./scales";

const WIDTH = 180;
const HEIGHT = 44;
const MARGIN = 4;

/** Small curve of an input's distribution; the sentence beside it says the same. */
export function DensityCurve({ distribution }: { distribution: Distribution | null | undefined }) {
  const drawn = shape(distribution);
  if (!drawn) return null;
  const [from, to] = rangeOf(
    drawn.heights.map(({ x }) => x),
    0.04,
  );
  const at = (x: number) => MARGIN + ((x - from) / (to - from)) * (WIDTH - 2 * MARGIN);
  const ends = [drawn.heights[0]?.x, drawn.heights.at(-1)?.x];
  return (
    <svg class="density" viewBox={`0 0 ${WIDTH} ${HEIGHT + 14}`} width={WIDTH} height={HEIGHT + 14} aria-hidden="true">
      {drawn.kind === "density" ? (
        <path class="area" d={outline(drawn, at)} />
      ) : (
        drawn.heights.map(({ x, y }) => <line key={x} class="stem" x1={at(x)} x2={at(x)} y1={HEIGHT} y2={height(y)} />)
      )}
      <line class="axis" x1={0} x2={WIDTH} y1={HEIGHT} y2={HEIGHT} />
      <text x={MARGIN} y={HEIGHT + 12}>
        {figure(Math.min(...ends.map((end) => end ?? 0)), 3)}
      </text>
      <text x={WIDTH - MARGIN} y={HEIGHT + 12} text-anchor="end">
        {figure(Math.max(...ends.map((end) => end ?? 0)), 3)}
      </text>
    </svg>
  );
}

function height(y: number): number {
  return HEIGHT - y * (HEIGHT - MARGIN);
}

function outline({ heights }: Shape, at: (x: number) => number): string {
  const [first, last] = [heights[0], heights.at(-1)];
  if (!first || !last) return "";
  const points = heights.map(({ x, y }) => `${at(x).toFixed(1)},${height(y).toFixed(1)}`);
  return `M${at(first.x).toFixed(1)},${HEIGHT}L${points.join("L")}L${at(last.x).toFixed(1)},${HEIGHT}Z`;
}
