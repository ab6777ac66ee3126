/** One plot of curves against time, drawn by uPlot. */

import uPlot from "uplot";
import { figure } from "../../parts/format";
import type { Clock } from "../playback/clock";
import type { Theme } from "../use-theme";

/** A curve. */
export interface Curve {
  name: string;
  colour: string;
  dash?: number[];
  time: number[];
  values: number[];
}

/** A marked event on a curve. */
export interface Mark {
  kind: "onset" | "peak" | "rest";
  colour: string;
  time: number;
  value: number;
}

/** Curves of a plot, and the events marked on them. */
export interface Plotted {
  curves: Curve[];
  marks: Mark[];
}

/** What a plot shows, and whom it tells. */
export interface PlotContent {
  name: string;
  unit: string;
  /** What is shown now: it may be replaced by curves of the same names. */
  plotted: { current: Plotted };
  width: number;
  theme: Theme;
  clock: Clock;
  /** Plots with the same key have one cursor. */
  syncKey: string;
  onRange: (range: [number, number]) => void;
}

const HEIGHT = 190;
/** Shortest drag that zooms [px]. */
const LEAST_DRAG = 6;

/** Makes a plot in an element; it follows the clock until `destroy`. */
export function plotIn(element: HTMLElement, content: PlotContent): uPlot {
  const { plotted, clock } = content;
  const plot = new uPlot(optionsOf(content), tableOf(plotted.current.curves), element);
  const line = document.createElement("div");
  line.className = "clock-line";
  plot.over.append(line);
  const follow = () => {
    const left = plot.valToPos(clock.time, "x");
    line.hidden = left < 0 || left > plot.over.clientWidth;
    line.style.transform = `translateX(${left}px)`;
  };
  const end = clock.onChange(follow);
  plot.hooks["draw"]?.push(follow);
  plot.hooks["destroy"] = [end];
  follow();
  bindMouse(plot, content);
  return plot;
}

/** Curves in one table, with the times of all. */
export function tableOf(curves: Curve[]): uPlot.AlignedData {
  const tables = curves.map(({ time, values }): uPlot.AlignedData => [time, values]);
  return tables.length > 0 ? uPlot.join(tables) : ([[0, 1]] as uPlot.AlignedData);
}

function bindMouse(plot: uPlot, { clock, onRange }: PlotContent): void {
  let wasDragged = false;
  plot.hooks["setSelect"] = [
    () => {
      const { left, width } = plot.select;
      if (width === 0) return;
      wasDragged = true;
      plot.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
      if (width >= LEAST_DRAG) onRange([plot.posToVal(left, "x"), plot.posToVal(left + width, "x")]);
    },
  ];
  plot.over.addEventListener("mousedown", () => (wasDragged = false));
  plot.over.addEventListener("click", (event) => {
    if (!wasDragged) clock.setTime(plot.posToVal(event.offsetX, "x"));
  });
}

function optionsOf({ name, unit, plotted, width, theme, syncKey }: PlotContent): uPlot.Options {
  const axis = {
    stroke: theme.quiet,
    grid: { stroke: theme.line, width: 1 },
    ticks: { stroke: theme.line, width: 1 },
    font: "12px system-ui, sans-serif",
  };
  return {
    width,
    height: HEIGHT,
    legend: { show: false },
    scales: { x: { time: false }, y: { range: (_, low, high) => rangeOf(low, high) } },
    axes: [
      { ...axis, size: 28, values: (_, values) => values.map((value) => figure(value, 6)) },
      { ...axis, size: 56, values: (_, values) => values.map((value) => figure(value, 4)) },
    ],
    series: [{}, ...plotted.current.curves.map((curve) => seriesOf(curve))],
    cursor: {
      y: false,
      drag: { x: true, y: false, setScale: false },
      sync: {
        key: syncKey,
        filters: { pub: (type) => type === "mousemove" || type === "mouseleave", sub: () => true },
      },
      bind: { dblclick: () => null },
    },
    hooks: {
      draw: [
        (plot) => {
          for (const mark of plotted.current.marks) draw(plot, mark, theme);
        },
      ],
      ready: [
        (plot) => {
          const canvas = plot.ctx.canvas;
          canvas.setAttribute("role", "img");
          canvas.setAttribute("aria-label", `${name} [${unit}] against time [s]; the values stand in the tables`);
        },
      ],
    },
  };
}

function seriesOf({ name, colour, dash }: Curve): uPlot.Series {
  return {
    label: name,
    stroke: colour,
    width: 1.75,
    spanGaps: true,
    points: { show: false },
    ...(dash ? { dash } : {}),
  };
}

/** Range of an axis that begins at 0, with room above. */
function rangeOf(low: number | null, high: number | null): [number, number] {
  const bottom = Math.min(0, low ?? 0);
  const top = Math.max(high ?? 0, bottom + 1e-9);
  return [bottom, top === 1e-9 ? 1 : top + 0.06 * (top - bottom)];
}

function draw(plot: uPlot, { kind, colour, time, value }: Mark, theme: Theme): void {
  const { ctx, bbox } = plot;
  const [x, y] = [plot.valToPos(time, "x", true), plot.valToPos(value, "y", true)];
  if (x < bbox.left || x > bbox.left + bbox.width) return;
  const r = 4.5 * devicePixelRatio;
  ctx.save();
  ctx.beginPath();
  if (kind === "onset") {
    ctx.moveTo(x, y - r);
    ctx.lineTo(x + r, y + r);
    ctx.lineTo(x - r, y + r);
    ctx.closePath();
  } else if (kind === "peak") ctx.arc(x, y, r, 0, 2 * Math.PI);
  else ctx.rect(x - r, y - r, 2 * r, 2 * r);
  ctx.fillStyle = colour;
  ctx.strokeStyle = theme.paper;
  ctx.lineWidth = 1.5 * devicePixelRatio;
  ctx.fill();
  ctx.stroke();
  ctx.restore();
}
