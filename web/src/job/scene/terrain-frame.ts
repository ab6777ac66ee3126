/** A frame round what happens on a terrain, whose surface is not drawn: a grid below it, and metres. */

import type { Group } from "three";
import { figure } from "../../parts/format";
import { multiples, niceStep } from "../../parts/round-values";
import type { Region } from "../region";
import type { Theme } from "../use-theme";
import { type Corner, Drawing } from "./drawing";

/** Digits of a number on an axis: maps are large beside what happens on them. */
const DIGITS = 6;
/** Lines of the grid along the longer side, at most about so many. */
const MOST_LINES = 10;
/** Height of the texts over the longer side. */
const SIZE = 0.022;
/** Least distance of the numbers upwards over their height. */
const APART = 2.5;

type Ends = [number, number];

/** A box with a grid at its lowest place and metres east, north and up. */
export class TerrainFrame {
  private readonly drawing = new Drawing();
  /** Height of the texts [m]. */
  private readonly size: number;
  /** Distances of the lines and numbers along the axes [m]. */
  private readonly steps: Corner;

  constructor(
    private readonly region: Region,
    private readonly theme: Theme,
  ) {
    const { low, high } = region;
    const length = Math.max(high[0] - low[0], high[1] - low[1]);
    const step = niceStep(length, MOST_LINES);
    this.size = SIZE * length;
    const height = high[2] - low[2];
    this.steps = [step, step, niceStep(height, height / (APART * this.size))];
    this.drawing.lines([...this.grid(), ...this.edges()], theme.isDark ? "#4a525d" : "#bcb7af");
    this.labels(0, "east", (x, gap) => [x, low[1] - gap, low[2]], [0.5, 1]);
    this.labels(1, "north", (y, gap) => [high[0] + gap, y, low[2]], [0, 0.8]);
    this.labels(2, "up", (z, gap) => [low[0] - gap, low[1], z], [1, 0.5]);
  }

  get group(): Group {
    return this.drawing.group;
  }

  dispose(): void {
    this.drawing.dispose();
  }

  private marks(axis: 0 | 1 | 2): number[] {
    return multiples(this.steps[axis], this.region.low[axis], this.region.high[axis]);
  }

  private grid(): Corner[] {
    const { low, high } = this.region;
    const along = this.marks(1).flatMap((y): Corner[] => [
      [low[0], y, low[2]],
      [high[0], y, low[2]],
    ]);
    const across = this.marks(0).flatMap((x): Corner[] => [
      [x, low[1], low[2]],
      [x, high[1], low[2]],
    ]);
    return [...along, ...across];
  }

  /** Edges of the box, without those above, which would lie over the flow. */
  private edges(): Corner[] {
    const { low, high } = this.region;
    const [xs, ys, zs] = ([0, 1, 2] as const).map((axis) => [low[axis], high[axis]]) as [Ends, Ends, Ends];
    return [
      ...ys.flatMap((y) => xs.map((x): Corner => [x, y, low[2]])),
      ...xs.flatMap((x) => ys.map((y): Corner => [x, y, low[2]])),
      ...xs.flatMap((x) => ys.flatMap((y) => zs.map((z): Corner => [x, y, z]))),
    ];
  }

  /** Writes the metres of an axis; the last of them names it. */
  private labels(axis: 0 | 1 | 2, name: string, place: (at: number, gap: number) => Corner, anchor: [number, number]) {
    const marks = this.marks(axis);
    marks.forEach((at, k) => {
      const text = `${figure(at, DIGITS)} m${k === marks.length - 1 ? ` ${name}` : ""}`;
      this.drawing.label(text, place(at, 0.3 * this.size), this.size, anchor, this.theme.ink);
    });
  }
}
