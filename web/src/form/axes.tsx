import type { ComponentChildren } from "preact";
import { marks } from "../parts/round-values";
import { type Frame, MARGIN, onPage } from "./frame";

interface ViewProps {
  frame: Frame;
  label: string;
  /** Name of the vertical axis. */
  vertical: string;
  children: ComponentChildren;
}

/** Pixels between two marks of an axis. */
const APART = { x: 64, v: 32 };

/** Room for the name of the horizontal axis at its end [px]. */
const NAMED = 45;

/** A drawing to scale with its axes [m]. */
export function View({ frame, label, vertical, children }: ViewProps) {
  const width = frame.width + MARGIN.left + MARGIN.right;
  const height = frame.height + MARGIN.top + MARGIN.bottom;
  return (
    <svg class="view" width={width} height={height} viewBox={`0 0 ${width} ${height}`} role="group" aria-label={label}>
      <svg x={MARGIN.left} y={MARGIN.top} width={frame.width} height={frame.height} role="presentation">
        {children}
      </svg>
      <g class="axes" transform={`translate(${MARGIN.left} ${MARGIN.top})`} aria-hidden="true">
        <rect width={frame.width} height={frame.height} />
        <Marks frame={frame} />
        <text x={frame.width} y={frame.height + 16} text-anchor="end">
          x [m]
        </text>
        <text x={-MARGIN.left + 2} y={9}>
          {vertical} [m]
        </text>
      </g>
    </svg>
  );
}

function Marks({ frame }: { frame: Frame }) {
  const { low, high, width, height } = frame;
  const across = marks(low[0], high[0], width / APART.x);
  const up = marks(low[1], high[1], height / APART.v);
  return (
    <>
      {across.map((value) => {
        const [x] = onPage(frame, [value, 0]);
        return (
          <g key={value}>
            <path d={`M${x} ${height}v4`} />
            {x < width - NAMED && (
              <text x={x} y={height + 16} text-anchor="middle">
                {signed(value)}
              </text>
            )}
          </g>
        );
      })}
      {up.map((value) => {
        const [, y] = onPage(frame, [0, value]);
        return (
          <g key={value}>
            <path d={`M0 ${y}h-4`} />
            {y > 16 && (
              <text x={-7} y={y + 4} text-anchor="end">
                {signed(value)}
              </text>
            )}
          </g>
        );
      })}
    </>
  );
}

const signed = (value: number) => String(value).replace("-", "−");
