/** The channel in a scene: bed, translucent walls, and lines with their metres. */

import type { Group } from "three";
import type { Schemas } from "../../api/client";
import { figure } from "../../parts/format";
import { multiples, niceStep } from "../../parts/round-values";
import type { Region } from "../region";
import type { Theme } from "../use-theme";
import { type Corner, Drawing } from "./drawing";

/** The part of a channel in a region. */
export class Channel {
  private readonly drawing = new Drawing();
  private readonly slope: number;
  private readonly from: number;
  private readonly to: number;
  private readonly half: number;

  constructor(
    channel: Schemas["Channel"],
    region: Region,
    private readonly theme: Theme,
  ) {
    this.slope = Math.tan((channel.inclination_deg * Math.PI) / 180);
    this.half = channel.width_m / 2;
    this.from = Math.max(-channel.incline_length_m, region.low[0]);
    this.to = Math.max(region.high[0], this.from + 1e-3);
    const step = niceStep(this.to - this.from, 8);
    const wall = this.wallHeight(region);
    // Lines lie a little above the bed, or it would hide parts of them.
    const above = 2e-3 * (this.to - this.from);
    this.drawing.surface(this.bed(0), theme.isDark ? "#2b3038" : "#e4e1dc", 1);
    for (const y of [-this.half, this.half]) this.drawing.surface(this.wall(y, wall), theme.ground, 0.13);
    if (this.from <= -channel.incline_length_m) this.drawing.surface(this.back(wall), theme.ground, 0.2);
    this.drawing.lines(this.grid(step, above), theme.isDark ? "#4a525d" : "#bcb7af");
    this.drawing.lines(this.across(0, above), theme.accent);
    if (this.to >= channel.runout_length_m)
      this.drawing.lines(this.across(channel.runout_length_m, above), theme.quiet);
    for (const x of multiples(step, this.from, this.to)) this.label(x, step);
  }

  get group(): Group {
    return this.drawing.group;
  }

  dispose(): void {
    this.drawing.dispose();
  }

  private height(x: number): number {
    return x < 0 ? -x * this.slope : 0;
  }

  private wallHeight(region: Region): number {
    return Math.min(2 * this.half, Math.max(0.3 * this.half, 0.08 * (region.high[0] - region.low[0])));
  }

  /** Places along the channel where the bed has corners. */
  private stations(): number[] {
    return this.from < 0 && this.to > 0 ? [this.from, 0, this.to] : [this.from, this.to];
  }

  private bed(above: number): Corner[] {
    const rows = this.stations().map((x): Corner[] =>
      [-this.half, this.half].map((y) => [x, y, this.height(x) + above]),
    );
    return quads(rows);
  }

  private wall(y: number, height: number): Corner[] {
    return quads(
      this.stations().map((x): Corner[] => [
        [x, y, this.height(x)],
        [x, y, this.height(x) + height],
      ]),
    );
  }

  private back(height: number): Corner[] {
    const low = this.height(this.from);
    return quads([
      [-this.half, this.half].map((y): Corner => [this.from, y, low]),
      [-this.half, this.half].map((y): Corner => [this.from, y, low + height]),
    ]);
  }

  private grid(step: number, above: number): Corner[] {
    const across = multiples(step, this.from, this.to).flatMap((x) => this.across(x, above));
    const stations = this.stations();
    const along = multiples(step, -this.half, this.half).flatMap((y) =>
      stations.slice(1).flatMap((x, k): Corner[] => {
        const before = stations[k] ?? x;
        return [
          [before, y, this.height(before) + above],
          [x, y, this.height(x) + above],
        ];
      }),
    );
    return [...across, ...along];
  }

  private across(x: number, above: number): Corner[] {
    return [-this.half, this.half].map((y) => [x, y, this.height(x) + above]);
  }

  private label(x: number, step: number): void {
    const size = 0.17 * step;
    const place: Corner = [x, -this.half - 0.3 * size, this.height(x)];
    // Left of the incline, below the floor: neither lies on the flow.
    this.drawing.label(x === 0 ? "0 m" : `${figure(x)} m`, place, size, x < 0 ? [1, 0.8] : [0.5, 1], this.theme.ink);
  }
}

/** Triangles between neighbouring rows of places. */
function quads(rows: Corner[][]): Corner[] {
  return rows.slice(1).flatMap((high, k) => {
    const [[a, b], [c, d]] = [rows[k] ?? [], high];
    return a && b && c && d ? [a, b, d, a, d, c] : [];
  });
}
