import "uplot/dist/uPlot.min.css";
import { useEffect, useRef, useState } from "preact/hooks";
import type uPlot from "uplot";
import type { Clock } from "../playback/clock";
import { useTheme } from "../use-theme";
import { useWidth } from "../use-width";
import { type Curve, type Mark, plotIn } from "./plot";

/** A quantity against time for all curves. */
export interface PlotSpec {
  name: string;
  unit: string;
  curves: Curve[];
  marks: Mark[];
}

type Range = [number, number];

/** Share of the present range that a press of "Zoom in" shows. */
const ZOOM = 0.5;

/** Plots with a common range of time, a common cursor, and the line of the clock. */
export function Plots({ plots, clock, syncKey }: { plots: PlotSpec[]; clock: Clock; syncKey: string }) {
  const [range, setRange] = useState<Range>();
  const zoom = (factor: number) => {
    const [from, to] = range ?? [0, clock.end];
    const half = ((to - from) * factor) / 2;
    const middle = Math.min(
      clock.end - Math.min(half, clock.end / 2),
      Math.max(Math.min(half, clock.end / 2), clock.time),
    );
    setRange(2 * half >= clock.end ? undefined : [middle - half, middle + half]);
  };
  return (
    <>
      <div class="actions">
        <button type="button" onClick={() => zoom(ZOOM)}>
          Zoom in
        </button>
        <button type="button" onClick={() => zoom(1 / ZOOM)} disabled={!range}>
          Zoom out
        </button>
        <button type="button" onClick={() => setRange(undefined)} disabled={!range}>
          Whole run
        </button>
        <span class="quiet" aria-live="polite">
          {range
            ? `${range[0].toFixed(3)} s to ${range[1].toFixed(3)} s`
            : "Drag across a plot to zoom; click to go to a time."}
        </span>
      </div>
      <div class="plots">
        {plots.map((plot) => (
          <Plot key={plot.name} {...plot} range={range} setRange={setRange} clock={clock} syncKey={syncKey} />
        ))}
      </div>
    </>
  );
}

interface PlotProps extends PlotSpec {
  range: Range | undefined;
  setRange: (range: Range | undefined) => void;
  clock: Clock;
  syncKey: string;
}

function Plot({ name, unit, curves, marks, range, setRange, clock, syncKey }: PlotProps) {
  const [element, width] = useWidth<HTMLDivElement>();
  const plot = useRef<uPlot>();
  const theme = useTheme();
  const show = (to: Range | undefined) => plot.current?.setScale("x", { min: to?.[0] ?? 0, max: to?.[1] ?? clock.end });
  useEffect(() => {
    if (!element.current || width < 80) return;
    plot.current = plotIn(element.current, {
      name,
      unit,
      curves,
      marks,
      width,
      theme,
      clock,
      syncKey,
      onRange: setRange,
    });
    show(range);
    return () => plot.current?.destroy();
  }, [curves, marks, width, theme]);
  useEffect(() => show(range), [range?.[0], range?.[1]]);
  return (
    <figure class="plot">
      <figcaption>
        {name} <span class="quiet">[{unit}]</span>
      </figcaption>
      <div ref={element} onDblClick={() => setRange(undefined)} />
    </figure>
  );
}
