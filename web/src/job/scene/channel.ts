/** The channel in a scene: bed, translucent walls, and lines with their metres. */

import {
  BufferGeometry,
  CanvasTexture,
  DoubleSide,
  Float32BufferAttribute,
  Group,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Mesh,
  MeshBasicMaterial,
  SRGBColorSpace,
  Sprite,
  SpriteMaterial,
  type Texture,
} from "three";
import type { Scenario } from "../../api/client";
import { figure } from "../../parts/format";
import { multiples, niceStep } from "../../parts/round-values";
import type { Region } from "../region";
import type { Theme } from "../use-theme";
import { colourOf } from "./flow-points";

type Corner = [number, number, number];

/** The part of a channel in a region. */
export class Channel {
  readonly group = new Group();
  private readonly made: { dispose(): void }[] = [];
  private readonly slope: number;
  private readonly from: number;
  private readonly to: number;
  private readonly half: number;

  constructor(
    scenario: Scenario,
    region: Region,
    private readonly theme: Theme,
  ) {
    const { channel } = scenario;
    this.slope = Math.tan((channel.inclination_deg * Math.PI) / 180);
    this.half = channel.width_m / 2;
    this.from = Math.max(-channel.incline_length_m, region.low[0]);
    this.to = Math.max(region.high[0], this.from + 1e-3);
    const step = niceStep(this.to - this.from, 8);
    const wall = this.wallHeight(region);
    // Lines lie a little above the bed, or it would hide parts of them.
    const above = 2e-3 * (this.to - this.from);
    this.surface(this.bed(0), theme.isDark ? "#2b3038" : "#e4e1dc", 1);
    for (const y of [-this.half, this.half]) this.surface(this.wall(y, wall), theme.ground, 0.13);
    if (this.from <= -channel.incline_length_m) this.surface(this.back(wall), theme.ground, 0.2);
    this.lines(this.grid(step, above), theme.isDark ? "#4a525d" : "#bcb7af");
    this.lines(this.across(0, above), theme.accent);
    if (this.to >= channel.runout_length_m) this.lines(this.across(channel.runout_length_m, above), theme.quiet);
    for (const x of multiples(step, this.from, this.to)) this.label(x, step);
  }

  dispose(): void {
    for (const part of this.made) part.dispose();
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

  private surface(corners: Corner[], colour: string, opacity: number): void {
    const material = new MeshBasicMaterial({
      color: colourOf(colour),
      side: DoubleSide,
      transparent: opacity < 1,
      opacity,
      depthWrite: opacity === 1,
    });
    this.group.add(new Mesh(this.geometry(corners), this.keep(material)));
  }

  private lines(corners: Corner[], colour: string): void {
    this.group.add(
      new LineSegments(this.geometry(corners), this.keep(new LineBasicMaterial({ color: colourOf(colour) }))),
    );
  }

  private label(x: number, step: number): void {
    const texture = this.keep(textOf(x === 0 ? "0 m" : `${figure(x)} m`, this.theme.ink));
    const sprite = new Sprite(this.keep(new SpriteMaterial({ map: texture, depthTest: false })));
    const size = 0.17 * step;
    sprite.scale.set((size * texture.image.width) / texture.image.height, size, 1);
    // Left of the incline, below the floor: neither lies on the flow.
    sprite.center.set(x < 0 ? 1 : 0.5, x < 0 ? 0.8 : 1);
    sprite.position.set(x, -this.half - 0.3 * size, this.height(x));
    this.group.add(sprite);
  }

  private geometry(corners: Corner[]): BufferGeometry {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute(corners.flat(), 3));
    return this.keep(geometry);
  }

  private keep<T extends BufferGeometry | Material | Texture>(part: T): T {
    this.made.push(part);
    return part;
  }
}

/** Triangles between neighbouring rows of places. */
function quads(rows: Corner[][]): Corner[] {
  return rows.slice(1).flatMap((high, k) => {
    const [[a, b], [c, d]] = [rows[k] ?? [], high];
    return a && b && c && d ? [a, b, d, a, d, c] : [];
  });
}

function textOf(text: string, colour: string): CanvasTexture<HTMLCanvasElement> {
  const canvas = document.createElement("canvas");
  const font = "44px system-ui, sans-serif";
  const context = canvas.getContext("2d");
  if (context) {
    context.font = font;
    canvas.width = Math.ceil(context.measureText(text).width) + 8;
    canvas.height = 56;
    context.font = font;
    context.fillStyle = colour;
    context.fillText(text, 4, 44);
  }
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  return texture;
}
