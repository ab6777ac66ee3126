import { memo } from "preact/compat";
import { useRef } from "preact/hooks";
import { type Place, outlineOf } from "../geometry/outline";
import type { Vector } from "../geometry/vectors";
import type { PlacedBody } from "../scenario/scene";
import { type Frame, onPage, pointsOf } from "./frame";

/** What moving a body does. */
export interface BodyMoves {
  /** Step of a move [m]. */
  step: number;
  /** Moves a body; one that is lifted leaves the bed. */
  move: (body: PlacedBody, to: Vector, isLifted: boolean, edit: string) => void;
  /** Keeps the frame as it is while a body is dragged. */
  hold: (isHeld: boolean) => void;
  /** Goes to the fields of a body. */
  pick: (index: number) => void;
}

/** The moves of the latest drawing, under one reference for all of them. */
export interface MovesReference {
  current: BodyMoves;
}

interface DraggableBodyProps {
  body: PlacedBody;
  frame: Frame;
  moves: MovesReference;
  /** True if bodies have their numbers beside them. */
  isNumbered: boolean;
  isSide: boolean;
}

/** Radius within which a finger meets a small body [px]. */
const FINGER = 14;

interface Drag {
  from: Place;
  centre: Vector;
  name: string;
}

/** A body that is moved with mouse, finger or arrow keys; drawn anew if it or the frame changed. */
export const DraggableBody = memo(function DraggableBody({
  body,
  frame,
  moves,
  isNumbered,
  isSide,
}: DraggableBodyProps) {
  const drag = useRef<Drag>();
  const across = isSide ? 2 : 1;
  const outline = outlineOf(
    body.core.map((vertex): Place => [vertex[0], vertex[across]]),
    body.solid.radius,
  );
  const [x, y] = onPage(frame, [body.centre[0], body.centre[across]]);
  const start = (event: PointerEvent & { currentTarget: SVGGElement }) => {
    if (event.button !== 0) return;
    event.currentTarget.setPointerCapture(event.pointerId);
    moves.current.hold(true);
    drag.current = {
      from: [event.clientX, event.clientY],
      centre: body.centre,
      name: `drag ${body.index} ${event.timeStamp}`,
    };
  };
  const follow = (event: PointerEvent) => {
    if (!drag.current) return;
    const { from, centre, name } = drag.current;
    const [dx, dv] = [(event.clientX - from[0]) / frame.scale, (from[1] - event.clientY) / frame.scale];
    if (Math.hypot(event.clientX - from[0], event.clientY - from[1]) < 2) return;
    moves.current.move(body, shifted(centre, dx, dv, isSide), isSide && (event.shiftKey || body.isElevated), name);
  };
  const end = () => {
    drag.current = undefined;
    moves.current.hold(false);
  };
  return (
    <g
      class={body.isFixed ? "body fixed" : "body"}
      // An SVG attribute: its case matters.
      tabindex={0}
      role="button"
      aria-label={`Body ${body.index}, ${body.solid.text}, x ${figure(body.centre[0])} m, ${isSide ? `z ${figure(body.centre[2])}` : `y ${figure(body.centre[1])}`} m`}
      aria-keyshortcuts="ArrowLeft ArrowRight ArrowUp ArrowDown PageUp PageDown"
      // Else the finger scrolls the page: touch-action does not reach into a drawing.
      onTouchStart={(event) => event.preventDefault()}
      onPointerDown={start}
      onPointerMove={follow}
      onPointerUp={end}
      onPointerCancel={end}
      onDblClick={() => moves.current.pick(body.index)}
      onKeyDown={(event) => onKey(event, body, moves.current, isSide)}
    >
      <circle class="target" cx={x} cy={y} r={FINGER} />
      <polygon points={pointsOf(frame, outline)} />
      <title>{`Body ${body.index}, ${body.solid.text}`}</title>
      {isNumbered && <BodyNumber index={body.index} outline={outline} frame={frame} place={[x, y]} />}
    </g>
  );
});

/** Number of a body: on it if there is room, else above or below it. */
function BodyNumber({ index, outline, frame, place }: { index: number; outline: Place[]; frame: Frame; place: Place }) {
  const tops = outline.map((corner) => onPage(frame, corner)[1]);
  const [highest, lowest] = [Math.min(...tops), Math.max(...tops)];
  const hasRoom = lowest - highest > 18;
  const beside = highest > 13 ? highest - 3 : lowest + 12;
  return (
    <text
      class={hasRoom ? "number inside" : "number"}
      x={place[0]}
      y={hasRoom ? place[1] + 4 : beside}
      text-anchor="middle"
      aria-hidden="true"
    >
      {index}
    </text>
  );
}

function shifted([x, y, z]: Vector, dx: number, dv: number, isSide: boolean): Vector {
  return isSide ? [x + dx, y, z + dv] : [x + dx, y + dv, z];
}

function onKey(event: KeyboardEvent, body: PlacedBody, moves: BodyMoves, isSide: boolean): void {
  if (event.key === "Enter" || event.key === " ") moves.pick(body.index);
  const way = WAYS[event.key];
  if (!way && event.key !== "Enter" && event.key !== " ") return;
  event.preventDefault();
  if (!way) return;
  const [dx, dv, isLift] = way;
  const step = moves.step * (event.shiftKey ? 10 : 1);
  const upwards = isSide || isLift;
  if (upwards && dv !== 0 && !isLift && !body.isElevated) return;
  moves.move(
    body,
    shifted(body.centre, dx * step, dv * step, upwards),
    upwards && (isLift || body.isElevated),
    `key ${body.index}`,
  );
}

/** Moves by key: downstream, up or across, and whether it lifts. */
const WAYS: Record<string, [number, number, boolean]> = {
  ArrowLeft: [-1, 0, false],
  ArrowRight: [1, 0, false],
  ArrowUp: [0, 1, false],
  ArrowDown: [0, -1, false],
  PageUp: [0, 1, true],
  PageDown: [0, -1, true],
};

const figure = (value: number) => Math.round(value * 1e5) / 1e5;
