/** Picture of flow and bodies from above, at one time. */

import type { Scenario } from "../../api/client";
import { outlineFromAbove } from "../../geometry/outline";
import { surfaceOf } from "../../geometry/surface";
import { turned } from "../../geometry/vectors";
import { figure } from "../../parts/format";
import { multiples, niceStep } from "../../parts/round-values";
import { bodyColour, viridis } from "../colours";
import type { FlowFrame } from "../flow/decoder";
import { type Between, type FramePair, eachPoint, framesAt, pairOf } from "../flow/frames";
import { type Poses, poseAt, sampleAt } from "../records/trajectories";
import type { Region } from "../region";
import type { Theme } from "../use-theme";

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

const MARGIN = { left: 44, right: 12, top: 10, bottom: 34 };
/** Lowest and highest part of the page that the channel takes [px]. */
const LEAST_HEIGHT = 90;
const MOST_HEIGHT = 460;
/** Sides of the squares of which the topmost point is drawn, and of its mark, over the points' distance:
 * marks that overlap, or the bed would show between them. */
const SQUARE = 0.6;
const DOT = 1.8;
/** Numbers stand on bodies if they are no more than this. */
const MOST_NUMBERED = 40;

/** Pixels of a metre, and the height of the picture, for its width. */
export interface Frame {
  scale: number;
  width: number;
  height: number;
  left: number;
  middle: number;
}

/** Layout of a picture as wide as this: equal scales, as large as fits. */
export function frameOf({ low, high }: Region, width: number): Frame {
  const [long, wide] = [high[0] - low[0], high[1] - low[1]];
  const scale = Math.min((width - MARGIN.left - MARGIN.right) / long, MOST_HEIGHT / wide);
  const inner = Math.max(LEAST_HEIGHT, wide * scale);
  const left = MARGIN.left + (width - MARGIN.left - MARGIN.right - long * scale) / 2 - low[0] * scale;
  return {
    scale,
    width,
    left,
    height: inner + MARGIN.top + MARGIN.bottom,
    middle: MARGIN.top + inner / 2 + ((high[1] + low[1]) / 2) * scale,
  };
}

/** Draws at a time; it keeps what two neighbouring frames have in common. */
export class AerialPainter {
  private pair: FramePair | undefined;
  private of: Pick<Between, "first" | "second"> | undefined;

  constructor(private readonly content: AerialContent) {}

  paint(context: CanvasRenderingContext2D, frame: Frame, time: number, theme: Theme): void {
    context.fillStyle = theme.paper;
    context.fillRect(0, 0, frame.width, frame.height);
    paintGround(context, frame, this.content, theme);
    this.paintFlow(context, frame, time);
    paintWalls(context, frame, this.content, theme);
    paintAxis(context, frame, this.content, theme);
    for (const poses of this.content.poses) paintTrail(context, frame, poses, time, theme);
    for (const poses of this.content.poses) paintBody(context, frame, this.content, poses, time, theme);
  }

  /** The topmost point in each of many small squares. */
  private paintFlow(context: CanvasRenderingContext2D, { scale, left, middle, width }: Frame, time: number): void {
    const { frames, spacing: spacingOf, scenario, topSpeed } = this.content;
    const between = framesAt(frames, time);
    if (!between) return;
    if (!this.pair || this.of?.first !== between.first || this.of.second !== between.second) {
      this.pair = pairOf(between);
      this.of = between;
    }
    const spacing = spacingOf(between.first.thinning);
    const bin = Math.max(1.5, SQUARE * spacing * scale);
    const side = Math.max(bin + 0.5, DOT * spacing * scale);
    const half = (scenario.channel.width_m / 2) * scale;
    context.save();
    context.beginPath();
    context.rect(0, middle - half, width, 2 * half);
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

/** Corners of the channel's part of the picture. */
function corners(frame: Frame, { scenario, region }: AerialContent): [number, number, number, number] {
  const at = placeOn(frame);
  const half = scenario.channel.width_m / 2;
  return [...at(region.low[0], half), ...at(Math.min(scenario.channel.runout_length_m, region.high[0]), -half)];
}

function paintGround(context: CanvasRenderingContext2D, frame: Frame, content: AerialContent, theme: Theme): void {
  const [x0, y0, x1, y1] = corners(frame, content);
  context.fillStyle = theme.raised;
  context.fillRect(x0, y0, x1 - x0, y1 - y0);
}

function paintWalls(context: CanvasRenderingContext2D, frame: Frame, content: AerialContent, theme: Theme): void {
  const { channel } = content.scenario;
  const { low, high } = content.region;
  const [x0, y0, x1, y1] = corners(frame, content);
  context.strokeStyle = theme.ground;
  context.lineWidth = 2;
  line(context, [x0, y0], [x1, y0]);
  line(context, [x0, y1], [x1, y1]);
  if (low[0] <= -channel.incline_length_m) line(context, [x0, y0], [x0, y1]);
  context.lineWidth = 1;
  context.setLineDash([2, 3]);
  if (high[0] >= channel.runout_length_m) line(context, [x1, y0], [x1, y1]);
  context.setLineDash([6, 4]);
  const [foot] = placeOn(frame)(0, 0);
  if (low[0] < 0 && high[0] > 0) line(context, [foot, y0], [foot, y1]);
  context.setLineDash([]);
}

function paintAxis(
  context: CanvasRenderingContext2D,
  frame: Frame,
  { region, scenario }: AerialContent,
  theme: Theme,
): void {
  const at = placeOn(frame);
  const half = scenario.channel.width_m / 2;
  context.fillStyle = theme.quiet;
  context.font = "12px system-ui, sans-serif";
  context.textAlign = "center";
  const base = at(0, -half)[1] + 16;
  for (const x of multiples(
    niceStep(region.high[0] - region.low[0], Math.max(3, frame.width / 110)),
    region.low[0],
    region.high[0],
  )) {
    context.fillText(x === 0 ? "0 m, foot" : `${figure(x)} m`, at(x, 0)[0], base);
    line(context, [at(x, 0)[0], base - 16], [at(x, 0)[0], base - 12]);
  }
  context.textAlign = "right";
  for (const y of [half, -half]) context.fillText(`${figure(y, 2)}`, at(region.low[0], 0)[0] - 6, at(0, y)[1] + 4);
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

function placeOn({ left, middle, scale }: Frame): (x: number, y: number) => [number, number] {
  return (x, y) => [left + x * scale, middle - y * scale];
}

function line(context: CanvasRenderingContext2D, from: [number, number], to: [number, number]): void {
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
  context.stroke();
}
