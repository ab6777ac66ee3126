/** Frames of a flow: found by time, and interpolated in pairs. */

import { FULL, type FlowFrame } from "./decoder";

/** Two neighbouring frames about a time, and the share of the way from the first to the second. */
export interface Between {
  first: FlowFrame;
  second: FlowFrame;
  share: number;
}

/** The frames about a time; before the first and after the last, that one twice. */
export function framesAt(frames: FlowFrame[], time: number): Between | undefined {
  let low = 0;
  let high = frames.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((frames[middle]?.time ?? 0) <= time) low = middle + 1;
    else high = middle;
  }
  const second = frames[low] ?? frames[frames.length - 1];
  const first = frames[low - 1] ?? second;
  if (!first || !second) return undefined;
  const span = second.time - first.time;
  const share = span > 0 ? Math.min(1, Math.max(0, (time - first.time) / span)) : 0;
  return { first, second, share };
}

/** Presence of a material point in a pair of frames. */
export const Presence = { Both: 0, FirstAlone: 1, SecondAlone: 2 } as const;

/** Points of two frames, matched by rank: quantised x, y, z and speed of each in both frames. */
export interface FramePair {
  count: number;
  start: Uint16Array;
  end: Uint16Array;
  presence: Uint8Array;
}

/** Matches two frames. A point of one frame alone stands still where it is. */
export function pairOf({ first, second }: Pick<Between, "first" | "second">): FramePair {
  const most = first.kept + (first === second ? 0 : second.kept);
  const pair = {
    count: 0,
    start: new Uint16Array(4 * most),
    end: new Uint16Array(4 * most),
    presence: new Uint8Array(most),
  };
  const isSame = first.thinning === second.thinning;
  let a = 0;
  let b = 0;
  while (a < first.kept || b < second.kept) {
    const rankA = a < first.kept ? (first.rank[a] ?? 0) : Infinity;
    const rankB = b < second.kept ? (second.rank[b] ?? 0) : Infinity;
    if (rankA === rankB && (isSame || first === second)) add(pair, a++, b++, first, second, Presence.Both);
    else if (rankA <= rankB) add(pair, a, a++, first, first, Presence.FirstAlone);
    else add(pair, b, b++, second, second, Presence.SecondAlone);
  }
  return { ...pair, start: pair.start.subarray(0, 4 * pair.count), end: pair.end.subarray(0, 4 * pair.count) };
}

function add(pair: FramePair, a: number, b: number, first: FlowFrame, second: FlowFrame, presence: number): void {
  put(pair.start, pair.count, first, a);
  put(pair.end, pair.count, second, b);
  pair.presence[pair.count] = presence;
  pair.count += 1;
}

function put(into: Uint16Array, place: number, frame: FlowFrame, point: number): void {
  into[4 * place] = frame.x[point] ?? 0;
  into[4 * place + 1] = frame.y[point] ?? 0;
  into[4 * place + 2] = frame.z[point] ?? 0;
  into[4 * place + 3] = frame.speed[point] ?? 0;
}

/** Calls back with x, y, z [m] and speed [m/s] of each point between two frames. */
export function eachPoint(
  { first, second, share }: Between,
  pair: FramePair,
  call: (x: number, y: number, z: number, speed: number) => void,
): void {
  const later = share < 0.5 ? Presence.SecondAlone : Presence.FirstAlone;
  const at = (frame: FlowFrame, values: Uint16Array, place: number, axis: 0 | 1 | 2) =>
    frame.origin[axis] + (frame.extent[axis] * (values[4 * place + axis] ?? 0)) / FULL;
  for (let place = 0; place < pair.count; place += 1) {
    const presence = pair.presence[place];
    if (presence === later) continue;
    const a = presence === Presence.SecondAlone ? second : first;
    const b = presence === Presence.FirstAlone ? first : second;
    const mixed = (axis: 0 | 1 | 2) =>
      at(a, pair.start, place, axis) * (1 - share) + at(b, pair.end, place, axis) * share;
    const slow = (a.largestSpeed * (pair.start[4 * place + 3] ?? 0)) / FULL;
    const fast = (b.largestSpeed * (pair.end[4 * place + 3] ?? 0)) / FULL;
    call(mixed(0), mixed(1), mixed(2), slow * (1 - share) + fast * share);
  }
}

/** Upper end of the scale of speed: a round number that covers nearly all points of all frames. */
export function topSpeed(frames: FlowFrame[]): number {
  const COVERED = 0.995;
  const speeds: number[] = [];
  for (const { speed, largestSpeed, kept } of frames) {
    const stride = Math.max(1, Math.floor((kept * frames.length) / 50_000));
    for (let place = 0; place < kept; place += stride) speeds.push(((speed[place] ?? 0) * largestSpeed) / FULL);
  }
  speeds.sort((a, b) => a - b);
  return roundUp(speeds[Math.floor(speeds.length * COVERED)] ?? 0);
}

/** The next round number of one digit, or of 1.5 and 2.5, times a power of ten. */
export function roundUp(value: number): number {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  const step = [1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10].find((step) => step * power >= value * (1 - 1e-9)) ?? 10;
  return Number((step * power).toPrecision(3));
}

/** Distance between neighbouring kept points [m], from the distance of all and their thinning. */
export function keptSpacing(cellSize: number, pointsPerCell: number, thinning: number): number {
  return cellSize * Math.cbrt(thinning / pointsPerCell);
}
