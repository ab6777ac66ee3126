/** Picture of flow and bodies from above, at one time. */

import type { Scenario } from "../../api/client";
import { outlineFromAbove } from "../../geometry/outline";
import { surfaceOf } from "../../geometry/surface";
import { turned } from "../../geometry/vectors";
import { bodyColour, viridis } from "../colours";
import type { FlowFrame } from "../flow/decoder";
import { type Between, type FramePair, eachPoint, framesAt, pairOf } from "../flow/frames";
import { type Poses, poseAt, sampleAt } from "../records/trajectories";
import type { Region } from "../region";
import type { Theme } from "../use-theme";
import { type Frame, line, placeOn } from "./frame";
import { type GroundPainter, groundPainter } from "./ground";

/** What a picture from above shows. */
export interface AerialContent {
  scenario: Scenario;
  poses: Poses[];
  frames: FlowFrame[];
  /** Distance between neighbouring kept points of a thinning [m]. */
  spacing: (thinning: number) => number;
  topSpeed: number;
  region: Region;
}

/** Sides of the squares of which the topmost point is drawn, and of its mark, over the points' distance:
 * marks that overlap, or the bed would show between them. */
const SQUARE = 0.6;
const DOT = 1.8;
/** Numbers stand on bodies if they are no more than this. */
const MOST_NUMBERED = 40;

/** Draws at a time; it keeps what two neighbouring frames have in common. */
export class AerialPainter {
  private pair: FramePair | undefined;
  private of: Pick<Between, "first" | "second"> | undefined;
  private readonly ground: GroundPainter;

  constructor(private readonly content: AerialContent) {
    this.ground = groundPainter(content.scenario, content.region);
  }

  paint(context: CanvasRenderingContext2D, frame: Frame, time: number, theme: Theme): void {
    context.fillStyle = theme.paper;
    context.fillRect(0, 0, frame.width, frame.height);
    this.ground.below(context, frame, theme);
    this.paintFlow(context, frame, time);
    this.ground.above(context, frame, theme);
    for (const poses of this.content.poses) paintTrail(context, frame, poses, time, theme);
    for (const poses of this.content.poses) paintBody(context, frame, this.content, poses, time, theme);
  }

  /** The topmost point in each of many small squares. */
  private paintFlow(context: CanvasRenderingContext2D, { scale, left, middle, width }: Frame, time: number): void {
    const { frames, spacing: spacingOf, topSpeed } = this.content;
    const between = framesAt(frames, time);
    if (!between) return;
    if (!this.pair || this.of?.first !== between.first || this.of.second !== between.second) {
      this.pair = pairOf(between);
      this.of = between;
    }
    const spacing = spacingOf(between.first.thinning);
    const bin = Math.max(1.5, SQUARE * spacing * scale);
    const side = Math.max(bin + 0.5, DOT * spacing * scale);
    const [lowest, highest] = this.ground.sides;
    context.save();
    context.beginPath();
    context.rect(0, middle - highest * scale, width, (highest - lowest) * scale);
    context.clip();
    const top = new Map<number, { x: number; y: number; z: number; speed: number }>();
    eachPoint(between, this.pair, (x, y, z, speed) => {
      const key = Math.floor((left + x * scale) / bin) + 65_536 * Math.floor((middle - y * scale) / bin);
      const there = top.get(key);
      if (!there || z > there.z) top.set(key, { x, y, z, speed });
    });
    // Lowest first, so that higher points hide lower ones.
    for (const { x, y, speed } of [...top.values()].sort((a, b) => a.z - b.z)) {
      context.fillStyle = viridis(speed / topSpeed);
      context.fillRect(left + x * scale - side / 2, middle - y * scale - side / 2, side, side);
    }
    context.restore();
  }
}

function paintTrail(context: CanvasRenderingContext2D, frame: Frame, poses: Poses, time: number, theme: Theme): void {
  const at = placeOn(frame);
  const last = sampleAt(poses.time, time);
  context.strokeStyle = bodyColour(poses.body, theme.isDark);
  context.lineWidth = 1.5;
  context.beginPath();
  for (let place = 0; place <= last; place += 1) {
    const [x = 0, y = 0] = poses.position[place] ?? [];
    context.lineTo(...at(x, y));
  }
  context.stroke();
}

function paintBody(
  context: CanvasRenderingContext2D,
  frame: Frame,
  { scenario, poses: all }: AerialContent,
  poses: Poses,
  time: number,
  theme: Theme,
): void {
  const given = scenario.bodies[poses.body];
  const pose = poseAt(poses, time);
  if (!given || !pose) return;
  const at = placeOn(frame);
  const colour = given.fixed ? theme.quiet : bodyColour(poses.body, theme.isDark);
  const surface = surfaceOf(given);
  context.beginPath();
  for (const [x, y] of outlineFromAbove(surface, pose.position, pose.orientation)) context.lineTo(...at(x, y));
  context.closePath();
  context.fillStyle = colour;
  context.globalAlpha = 0.75;
  context.fill();
  context.globalAlpha = 1;
  context.strokeStyle = theme.paper;
  context.lineWidth = 1.5;
  context.stroke();
  paintHeading(context, at, pose, Math.cbrt(surface.volume) / 2, theme);
  if (all.length > MOST_NUMBERED || all.length < 2) return;
  context.fillStyle = theme.isDark ? "#000000" : "#ffffff";
  context.textAlign = "center";
  const [x, y] = at(pose.position[0], pose.position[1]);
  context.fillText(String(poses.body), x, y + 4);
}

/** A line from the centre along the body's x axis: how the body is turned. */
function paintHeading(
  context: CanvasRenderingContext2D,
  at: (x: number, y: number) => [number, number],
  { position, orientation }: NonNullable<ReturnType<typeof poseAt>>,
  reach: number,
  theme: Theme,
): void {
  const [x, y] = turned(orientation, [reach, 0, 0]);
  context.strokeStyle = theme.isDark ? "#000000" : "#ffffff";
  line(context, at(position[0] + 0.6 * x, position[1] + 0.6 * y), at(position[0] + x, position[1] + y));
}
