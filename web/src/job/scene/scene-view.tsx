import { useEffect, useRef, useState } from "preact/hooks";
import type { AerialContent } from "../aerial/draw";
import type { Clock } from "../playback/clock";
import { saveFile } from "../../parts/save-file";
import { useTheme } from "../use-theme";
import { CAMERAS, type CameraName } from "./cameras";
import { SceneViewer } from "./viewer";

/** A run in three dimensions, at the time of the clock; tells if the browser cannot show it. */
export function SceneView({ content, clock, fail }: { content: AerialContent; clock: Clock; fail: () => void }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [viewer, setViewer] = useState<SceneViewer>();
  const theme = useTheme();
  useEffect(() => {
    if (!canvas.current) return;
    let made: SceneViewer;
    try {
      made = new SceneViewer(canvas.current, clock);
    } catch {
      fail();
      return;
    }
    setViewer(made);
    return () => made.dispose();
  }, [clock]);
  useEffect(() => viewer?.show(content, theme), [viewer, content, theme]);
  return (
    <>
      <div class="scene">
        <canvas
          ref={canvas}
          tabIndex={0}
          role="img"
          aria-label="Flow and bodies in three dimensions. Arrow keys move the view, with Shift they turn it, plus and minus zoom."
        />
        <FrameRate viewer={viewer} />
      </div>
      <div class="actions">
        {(Object.keys(CAMERAS) as CameraName[]).map((name) => (
          <button key={name} type="button" onClick={() => viewer?.look(name)}>
            {CAMERAS[name].name}
          </button>
        ))}
        <button
          type="button"
          onClick={() =>
            void viewer?.picture().then((blob) => blob && saveFile(blob, `scene-${clock.time.toFixed(3)}s.png`))
          }
        >
          Save picture
        </button>
        <span class="quiet hint">Drag to turn, right button to move, wheel to zoom.</span>
      </div>
    </>
  );
}

/** Pictures per second, shown on demand. */
function FrameRate({ viewer }: { viewer: SceneViewer | undefined }) {
  const [isShown, setIsShown] = useState(false);
  const [rate, setRate] = useState(0);
  useEffect(() => {
    if (!viewer || !isShown) return;
    viewer.onFrame = (rate) => setRate(Math.round(rate));
    return () => (viewer.onFrame = undefined);
  }, [viewer, isShown]);
  return (
    <label class="frame-rate">
      <input type="checkbox" checked={isShown} onChange={(event) => setIsShown(event.currentTarget.checked)} /> Frame
      rate
      {isShown && <span> {rate} /s</span>}
    </label>
  );
}
