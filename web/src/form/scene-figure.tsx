import { useRef, useState } from "preact/hooks";
import type { Vector } from "../geometry/vectors";
import { snapped } from "../parts/round-values";
import { useWidth } from "../parts/use-width";
import { changed, isObject, at, member } from "../parts/json-document";
import { groundOf } from "../scenario/ground";
import { type PlacedBody, type Scene, extentOf, sceneText } from "../scenario/scene";
import type { BodyMoves } from "./draggable-body";
import { useForm } from "./form-context";
import { type Zoom, framesOf } from "./frame";
import { SideView, TopView } from "./views";

/** Most bodies that have their numbers beside them. */
const NUMBERED = 40;

/** Size of bodies below which numbers of several would cover each other [px]. */
const SMALLEST_NUMBERED = 18;

/** Drawings of the scene at its start, or a sentence in their place. */
export function SceneFigure() {
  const { document } = useForm();
  if (groundOf(document) === "channel") return <ChannelFigure />;
  return <p class="notice">A terrain is not drawn here. The pictures of the job show its flow and its bodies.</p>;
}

/** Drawings of the scene from the side and from above. */
function ChannelFigure() {
  const { scene } = useForm();
  const [figure, width] = useWidth<HTMLElement>();
  // While a number is being typed the channel may be incomplete: the drawing stays.
  const latest = useRef(scene);
  if (scene) latest.current = scene;
  const drawn = latest.current;
  return (
    <figure class={scene ? "scene" : "scene outdated"} ref={figure}>
      {!scene && (
        <p class="notice">
          The channel can't be drawn as it is: it needs an inclination below 90°, an incline length and a run-out
          length.
        </p>
      )}
      {drawn && width > 0 && <Views scene={drawn} width={width} />}
    </figure>
  );
}

const NO_MOVES: BodyMoves = { step: 1, move: () => undefined, hold: () => undefined, pick: () => undefined };

function Views({ scene, width }: { scene: Scene; width: number }) {
  const { reveal } = useForm();
  const [zoom, setZoom] = useState<Zoom>("channel");
  const held = useRef<ReturnType<typeof framesOf>>();
  const [said, setSaid] = useState("");
  const move = useMove(scene, setSaid);
  // A frame round the bodies would follow the one that is dragged.
  const frames = useSame(held.current ?? framesOf(scene, zoom, width));
  const moves = useRef<BodyMoves>(NO_MOVES);
  moves.current = {
    step: frames.step,
    move: (body, to, isLifted, edit) => move(body, to, isLifted, edit, frames.step),
    hold: (isHeld) => (held.current = isHeld ? frames : undefined),
    pick: (index) => reveal(member("/bodies", index)),
  };
  const isNumbered = hasRoomForNumbers(scene, frames.side.scale);
  return (
    <>
      <ZoomChoice zoom={zoom} setZoom={setZoom} isOf={scene.bodies.length > 0} />
      <SideView scene={scene} frame={frames.side} moves={moves} isNumbered={isNumbered} />
      <TopView scene={scene} frame={frames.top} moves={moves} isNumbered={isNumbered} />
      <figcaption>
        <p>{sceneText(scene)}</p>
        {scene.missing.length > 0 && (
          <p class="violation">
            Not drawn, since its shape is incomplete: body {scene.missing.slice(0, 5).join(", ")}.
          </p>
        )}
        {scene.bodies.length > 0 && (
          <p class="quiet">
            Drag a body to move it, by {frames.step} m at a time, or select it and use the arrow keys. With Shift, or
            Page Up, it is lifted off the bed.
          </p>
        )}
      </figcaption>
      <p class="hidden" aria-live="polite">
        {said}
      </p>
    </>
  );
}

function hasRoomForNumbers({ bodies }: Scene, scale: number): boolean {
  if (bodies.length < 2) return true;
  return bodies.length <= NUMBERED && scale * Math.max(...bodies.map(extentOf)) > SMALLEST_NUMBERED / 2;
}

function ZoomChoice({ zoom, setZoom, isOf }: { zoom: Zoom; setZoom: (zoom: Zoom) => void; isOf: boolean }) {
  if (!isOf) return null;
  return (
    <div class="choice" role="group" aria-label="Part that is shown">
      {(["channel", "bodies"] as const).map((part) => (
        <button key={part} type="button" aria-pressed={zoom === part} onClick={() => setZoom(part)}>
          {part === "channel" ? "Whole channel" : "Around the bodies"}
        </button>
      ))}
    </div>
  );
}

/** Moves a body in the document, within the channel and by whole steps. */
function useMove(scene: Scene, say: (text: string) => void) {
  const { document, replace } = useForm();
  return (body: PlacedBody, to: Vector, isLifted: boolean, edit: string, step: number) => {
    const { incline, runout, width } = scene.channel;
    const within = (value: number, low: number, high: number) => snapped(Math.min(high, Math.max(low, value)), step);
    const pointer = member("/bodies", body.index);
    const position: Record<string, number> = {};
    if (to[0] !== body.centre[0]) position["downstream_m"] = within(to[0], -incline, runout);
    if (to[1] !== body.centre[1]) position["lateral_m"] = within(to[1], -width / 2, width / 2);
    if (isLifted && to[2] !== body.centre[2]) position["elevation_m"] = within(to[2], 0, Infinity);
    const before = at(document, `${pointer}/position`);
    const next = { ...(isObject(before) ? before : {}), ...position };
    replace(changed(document, `${pointer}/position`, next), edit);
    say(
      `Body ${body.index}: ${Object.entries(position)
        .map(([key, value]) => `${key.replace("_m", "")} ${value} m`)
        .join(", ")}`,
    );
  };
}

/** The value of before as long as it is equal, so that what is drawn with it stays. */
function useSame<T>(value: T): T {
  const latest = useRef(value);
  if (JSON.stringify(latest.current) !== JSON.stringify(value)) latest.current = value;
  return latest.current;
}
