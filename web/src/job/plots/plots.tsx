import "uplot/dist/uPlot.min.css";
import { useEffect, useRef, useState } from "preact/hooks";
import type uPlot from "uplot";
import { useWidth } from "../../parts/use-width";
import type { Clock } from "../playback/clock";
import { useTheme } from "../use-theme";
import { type Plotted, plotIn, tableOf } from "./plot";

/** A quantity against time for all curves. */
export interface PlotSpec extends Plotted {
  name: string;
  unit: string;
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
  const plotted = useRef<Plotted>({ curves, marks });
  plotted.current = { curves, marks };
  const drawn = useRef<Plotted["curves"]>();
  const names = curves.map(({ name, colour }) => name + colour).join(" ");
  const show = (to: Range | undefined) => plot.current?.setScale("x", { min: to?.[0] ?? 0, max: to?.[1] ?? clock.end });
  useEffect(() => {
    if (!element.current || width < 80) return;
    plot.current = plotIn(element.current, {
      name,
      unit,
      plotted,
      width,
      theme,
      clock,
      syncKey,
      onRange: setRange,
    });
    drawn.current = curves;
    show(range);
    return () => {
      plot.current?.destroy();
      plot.current = undefined;
    };
  }, [names, width, theme]);
  useEffect(() => {
    // Only what is drawn is exchanged: a plot that was made again would lose a drag that has begun.
    if (drawn.current !== curves) plot.current?.setData(tableOf(curves), false);
    drawn.current = curves;
    show(range);
  }, [curves, marks, clock.end]);
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
