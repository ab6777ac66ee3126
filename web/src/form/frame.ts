/** Frames of the two views: the part of the scene that they show, and its scale. */

import type { Place } from "../geometry/outline";
import { roundBelow } from "../parts/round-values";
import { type Scene, bedAt, extentOf } from "../scenario/scene";

/** Part of the scene that is shown. */
export type Zoom = "channel" | "bodies";

/** A view's place on the page [px] and in the scene [m]. */
export interface Frame {
  /** Width and height of the drawing without its margins [px]. */
  width: number;
  height: number;
  /** Lowest and highest place that is shown [m]. */
  low: Place;
  high: Place;
  /** Pixels per metre, the same for both views. */
  scale: number;
}

/** Margins of a view, where the axes are [px]. */
export const MARGIN = { left: 44, right: 12, top: 10, bottom: 22 };

/** Largest heights of the drawings [px]. */
const TALLEST = { side: 270, top: 180 };

interface Span {
  x: Place;
  y: Place;
  z: Place;
}

/** Frames of the view from the side and from above in a figure of this width [px]. */
export function framesOf(scene: Scene, zoom: Zoom, figureWidth: number): { side: Frame; top: Frame; step: number } {
  const width = Math.max(120, figureWidth - MARGIN.left - MARGIN.right);
  const { x, y, z } = zoom === "bodies" && scene.bodies.length > 0 ? aroundBodies(scene) : ofChannel(scene);
  const scale = Math.min(width / (x[1] - x[0]), TALLEST.side / (z[1] - z[0]), TALLEST.top / (y[1] - y[0]));
  const spare = (width / scale - (x[1] - x[0])) / 2;
  const ends: Place = [x[0] - spare, x[1] + spare];
  const frame = (v: Place): Frame => ({
    width,
    height: (v[1] - v[0]) * scale,
    low: [ends[0], v[0]],
    high: [ends[1], v[1]],
    scale,
  });
  return { side: frame(z), top: frame(y), step: roundBelow((x[1] - x[0]) / 400) };
}

function ofChannel({ channel, release, bodies }: Scene): Span {
  const x: Place = [-channel.incline, channel.runout];
  let top = Math.max(bedAt(channel, x[0]), channel.width / 4);
  if (release) {
    x[0] = Math.min(x[0], release.back);
    top = Math.max(top, bedAt(channel, release.back) + release.vertical);
  }
  let side = channel.width / 2;
  for (const body of bodies) {
    const extent = extentOf(body);
    const [cx, cy, cz] = body.centre;
    x[0] = Math.min(x[0], cx - extent);
    x[1] = Math.max(x[1], cx + extent);
    side = Math.max(side, Math.abs(cy) + extent);
    top = Math.max(top, cz + extent);
  }
  const pad = 0.02 * (x[1] - x[0]);
  return { x: [x[0] - pad, x[1] + pad], y: [-side - pad / 2, side + pad / 2], z: [-pad, top + pad] };
}

function aroundBodies({ channel, bodies }: Scene): Span {
  const ends = (axis: 0 | 1 | 2): Place => [
    Math.min(...bodies.map((body) => body.centre[axis] - extentOf(body))),
    Math.max(...bodies.map((body) => body.centre[axis] + extentOf(body))),
  ];
  const pad = 1.5 * Math.max(...bodies.map(extentOf));
  const wider = ([low, high]: Place): Place => [low - pad, high + pad];
  const [x, y, z] = [wider(ends(0)), wider(ends(1)), ends(2)];
  const half = channel.width / 2 + pad / 8;
  return {
    x,
    y: [Math.max(y[0], Math.min(-half, y[0] + pad)), Math.min(y[1], Math.max(half, y[1] - pad))],
    z: [Math.min(z[0], bedAt(channel, x[1])) - pad / 4, z[1] + pad],
  };
}

/** Place of the drawing [px] of a place of the scene [m]. */
export function onPage({ low, high, scale }: Frame, [x, v]: Place): Place {
  return [(x - low[0]) * scale, (high[1] - v) * scale];
}

/** Points of an SVG polygon. */
export function pointsOf(frame: Frame, places: Place[]): string {
  return places
    .map((place) =>
      onPage(frame, place)
        .map((part) => part.toFixed(2))
        .join(","),
    )
    .join(" ");
}
