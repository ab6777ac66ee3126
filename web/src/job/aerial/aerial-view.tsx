import { useEffect, useMemo, useRef } from "preact/hooks";
import { figure } from "../../parts/format";
import { useWidth } from "../../parts/use-width";
import { type Ground, groundOf } from "../../scenario/ground";
import type { Clock } from "../playback/clock";
import { useTheme } from "../use-theme";
import { type AerialContent, AerialPainter } from "./draw";
import { frameOf } from "./frame";

/** How a picture lies on the page. */
const AXES: Record<Ground, string> = {
  channel: "x downstream to the right",
  terrain: "east to the right and north up",
};

/** Flow and bodies from above, at the time of the clock. */
export function AerialView({ content, clock, name }: { content: AerialContent; clock: Clock; name: string }) {
  const [box, width] = useWidth<HTMLDivElement>();
  const canvas = useRef<HTMLCanvasElement>(null);
  const theme = useTheme();
  const painter = useMemo(() => new AerialPainter(content), [content]);
  const frame = useMemo(() => frameOf(content.region, Math.max(200, width)), [content, width]);
  useEffect(() => {
    const context = canvas.current?.getContext("2d");
    if (!canvas.current || !context || width === 0) return;
    const ratio = devicePixelRatio;
    canvas.current.width = Math.round(frame.width * ratio);
    canvas.current.height = Math.round(frame.height * ratio);
    canvas.current.style.width = `${frame.width}px`;
    canvas.current.style.height = `${frame.height}px`;
    let asked = 0;
    const paint = () => {
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
      painter.paint(context, frame, clock.time, theme);
    };
    paint();
    const end = clock.onChange(() => {
      cancelAnimationFrame(asked);
      asked = requestAnimationFrame(paint);
    });
    return () => {
      end();
      cancelAnimationFrame(asked);
    };
  }, [painter, frame, theme, width, clock]);
  return (
    <div ref={box} class="aerial">
      <canvas
        ref={canvas}
        role="img"
        aria-label={`${name}: flow and bodies from above, ${AXES[groundOf(content.scenario)]}`}
      />
    </div>
  );
}

/** Scale of the flow's speed. */
export function SpeedScale({ top }: { top: number }) {
  return (
    <div class="speed-scale">
      <span>0</span>
      <span
        class="viridis"
        role="img"
        aria-label={`Colours of the flow's speed from 0, dark, to ${figure(top)} m/s, yellow`}
      />
      <span>{figure(top)} m/s and more</span>
      <span class="quiet">speed of the flow</span>
    </div>
  );
}
