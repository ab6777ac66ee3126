import type { Place } from "../geometry/outline";
import { type Channel, type Release, type Scene, bedAt } from "../scenario/scene";
import { View } from "./axes";
import { DraggableBody, type MovesReference } from "./draggable-body";
import { type Frame, onPage, pointsOf } from "./frame";
import "./views.css";

interface SceneViewProps {
  scene: Scene;
  frame: Frame;
  moves: MovesReference;
  isNumbered: boolean;
}

/** View from the side, x–z. */
export function SideView({ scene: { channel, release, bodies }, frame, moves, isNumbered }: SceneViewProps) {
  const far = frame.low[1] - 1;
  const bed: Place[] = [
    [-channel.incline, bedAt(channel, -channel.incline)],
    [0, 0],
    [Math.max(channel.runout, frame.high[0]), 0],
  ];
  const below: Place[] = [...bed, [Math.max(channel.runout, frame.high[0]), far], [-channel.incline, far]];
  const [wallX, wallY] = onPage(frame, bed[0]!);
  const [endX, endY] = onPage(frame, [channel.runout, 0]);
  return (
    <View frame={frame} label="View from the side" vertical="z">
      {release && <polygon class="release" points={pointsOf(frame, releaseOutline(release, channel))} />}
      <polygon class="ground" points={pointsOf(frame, below)} />
      <polyline class="bed" points={pointsOf(frame, bed)} />
      <path class="wall" d={`M${wallX} ${wallY}V0`} />
      <path class="open-end" d={`M${endX} ${endY}V0`} />
      <Inclination channel={channel} frame={frame} />
      {release && <Thickness release={release} channel={channel} frame={frame} />}
      {bodies.map((body) => (
        <DraggableBody key={body.index} body={body} frame={frame} moves={moves} isNumbered={isNumbered} isSide />
      ))}
    </View>
  );
}

function releaseOutline({ back, front, vertical }: Release, channel: Channel): Place[] {
  const [high, low] = [bedAt(channel, back), bedAt(channel, front)];
  return [
    [back, high],
    [front, low],
    [front, low + vertical],
    [back, high + vertical],
  ];
}

/** Angle of the incline at its foot. */
function Inclination({ channel, frame }: { channel: Channel; frame: Frame }) {
  const reach = Math.min(channel.incline * frame.scale, 90) * 0.5;
  const [x, y] = onPage(frame, [0, 0]);
  const { inclination } = channel;
  if (inclination === 0 || reach < 15) return null;
  const [toX, toY] = [x - reach * Math.cos(inclination), y - reach * Math.sin(inclination)];
  const degrees = Number(((inclination * 180) / Math.PI).toPrecision(4));
  return (
    <g class="dimension">
      <path d={`M${x - reach} ${y}H${x}`} />
      <path d={`M${x - reach} ${y}A${reach} ${reach} 0 0 1 ${toX} ${toY}`} />
      <text class="on-ground" x={x - reach - 4} y={y - 4} text-anchor="end">
        {degrees}°
      </text>
    </g>
  );
}

/** Thickness of the release, normal to the slope, in its middle. */
function Thickness({ release, channel, frame }: { release: Release; channel: Channel; frame: Frame }) {
  const middle = (release.back + release.front) / 2;
  const { height } = release;
  const foot: Place = [middle, bedAt(channel, middle)];
  const end: Place = [
    foot[0] + height * Math.sin(channel.inclination),
    foot[1] + height * Math.cos(channel.inclination),
  ];
  const [[x0, y0], [x1, y1]] = [onPage(frame, foot), onPage(frame, end)];
  return (
    <g class="dimension">
      <path d={`M${x0} ${y0}L${x1} ${y1}`} />
      <text x={x1 + 5} y={y1 - 3}>
        {height} m
      </text>
    </g>
  );
}

/** View from above, x–y. */
export function TopView({ scene: { channel, release, bodies }, frame, moves, isNumbered }: SceneViewProps) {
  const half = channel.width / 2;
  const box = (from: number, to: number) =>
    pointsOf(frame, [
      [from, half],
      [to, half],
      [to, -half],
      [from, -half],
    ]);
  const [left, upper] = onPage(frame, [-channel.incline, half]);
  const [right, lower] = onPage(frame, [channel.runout, -half]);
  const [footX, middleY] = onPage(frame, [0, 0]);
  return (
    <View frame={frame} label="View from above" vertical="y">
      <polygon class="incline" points={box(-channel.incline, 0)} />
      <polygon class="floor" points={box(0, channel.runout)} />
      {release && <polygon class="release" points={box(release.back, release.front)} />}
      <path class="centre" d={`M${left} ${middleY}H${right}`} />
      <path class="open-end" d={`M${footX} ${upper}V${lower}M${right} ${upper}V${lower}`} />
      <path class="wall" d={`M${right} ${upper}H${left}V${lower}H${right}`} />
      {bodies.map((body) => (
        <DraggableBody
          key={body.index}
          body={body}
          frame={frame}
          moves={moves}
          isNumbered={isNumbered}
          isSide={false}
        />
      ))}
    </View>
  );
}
