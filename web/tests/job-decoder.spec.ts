import { expect, test } from "@playwright/test";
import { FlowDecoder, type FlowFrame } from "../src/job/flow/decoder";
import { eachPoint, framesAt, keptSpacing, pairOf, roundUp, topSpeed } from "../src/job/flow/frames";
import { type PlainFrame, encoded, sliding } from "./job-frames";

function decoded(bytes: Uint8Array, pieces: number): FlowFrame[] {
  const decoder = new FlowDecoder();
  const frames: FlowFrame[] = [];
  for (let at = 0; at < bytes.length; at += pieces) frames.push(...decoder.push(bytes.subarray(at, at + pieces)));
  decoder.finish();
  return frames;
}

const LEAVING: PlainFrame[] = [
  {
    time: 0,
    ranks: [0, 1, 5],
    positions: [
      [0, 0, 0],
      [1, 0, 0],
      [2, 1, 4],
    ],
    speeds: [0, 1, 2],
  },
  {
    time: 1,
    ranks: [1, 5, 9],
    positions: [
      [3, 0, 0],
      [2, 1, 0],
      [9, 9, 9],
    ],
    speeds: [2, 2, 4],
  },
];

test("frames are the same however the stream is cut", () => {
  const bytes = encoded(sliding(301, 4, 1));
  const whole = decoded(bytes, bytes.length);
  expect(whole.map(({ time, kept }) => [time, kept])).toEqual([0, 1, 2, 3].map((k) => [k / 3, 301]));
  for (const pieces of [1, 7, 16, 64, 1000]) expect(decoded(bytes, pieces)).toEqual(whole);
});

test("positions and speeds come back within the steps of their quantisation", () => {
  const plain = sliding(200, 2, 1)[1] as PlainFrame;
  const [frame] = decoded(encoded([plain]), 50) as [FlowFrame];
  for (const k of [0, 99, 199]) {
    const x = frame.origin[0] + (frame.extent[0] * (frame.x[k] ?? 0)) / 65_535;
    expect(Math.abs(x - (plain.positions[k]?.[0] ?? 0))).toBeLessThan(1e-5);
    expect(Math.abs((frame.largestSpeed * (frame.speed[k] ?? 0)) / 65_535 - (plain.speeds[k] ?? 0))).toBeLessThan(1e-4);
  }
});

test("an empty stream and frames without points are no error", () => {
  expect(decoded(encoded([]), 16)).toEqual([]);
  const [frame] = decoded(encoded([{ time: 0.5, ranks: [], positions: [], speeds: [] }]), 3) as [FlowFrame];
  expect([frame.time, frame.kept]).toEqual([0.5, 0]);
});

test("what is no stream of frames is refused with its reason", () => {
  const bytes = encoded(sliding(20, 3, 1));
  const spoilt = (at: number, value: number) => {
    const copy = Buffer.from(bytes);
    copy.writeUInt32LE(value, at);
    return copy;
  };
  expect(() => decoded(new TextEncoder().encode('{"type":"urn:scree:problem"}'), 4)).toThrow(
    "do not begin as flow frames do",
  );
  expect(() => decoded(spoilt(8, 2), 1)).toThrow("version is 2");
  expect(() => decoded(spoilt(16 + 16, 4_000_000_000), 9)).toThrow("says that it has 4000000000 points");
  expect(() => decoded(spoilt(16 + 20, 0), 9)).toThrow("thinning of 0");
  expect(() => decoded(spoilt(16 + 24, 0x7fc00000), 9)).toThrow("not finite");
  expect(() => decoded(spoilt(16 + 56, 0), 9)).toThrow("ranks of a frame do not ascend");
  expect(() => decoded(bytes.subarray(0, bytes.length - 1), 100)).toThrow("broke off after 2 of 3");
  expect(() => decoded(bytes.subarray(0, 12), 100)).toThrow("before the first one");
  expect(() => decoded(Buffer.concat([bytes, Buffer.alloc(8)]), 100)).toThrow("more after the last frame");
});

test("points are matched by rank, and those that leave or appear are in one half alone", () => {
  const frames = decoded(encoded(LEAVING), 30);
  const between = framesAt(frames, 0.25);
  if (!between) throw new Error("no frames");
  const pair = pairOf(between);
  expect([...pair.presence.subarray(0, pair.count)]).toEqual([1, 0, 0, 2]);
  const seen: number[][] = [];
  eachPoint(between, pair, (...point) => seen.push(point.map((value) => Number(value.toFixed(3)))));
  expect(seen).toEqual([
    [0, 0, 0, 0],
    [1.5, 0, 0, 1.25],
    [2, 1, 3, 2],
  ]);
  const late: number[][] = [];
  eachPoint({ ...between, share: 0.75 }, pair, (...point) => late.push(point));
  expect(late.map(([x]) => Number(x?.toFixed(2)))).toEqual([2.5, 2, 9]);
});

test("points of frames with different thinnings are not taken for the same", () => {
  const [first, second] = LEAVING as [PlainFrame, PlainFrame];
  const frames = decoded(encoded([first, { ...second, thinning: 2 }]), 30) as [FlowFrame, FlowFrame];
  const pair = pairOf({ first: frames[0], second: frames[1] });
  expect(pair.count).toBe(6);
});

test("frames are found at any time", () => {
  const frames = decoded(encoded(LEAVING), 30);
  expect(framesAt([], 1)).toBeUndefined();
  expect(framesAt(frames, -1)?.share).toBe(0);
  expect(framesAt(frames, 0.5)?.share).toBe(0.5);
  const last = framesAt(frames, 7);
  expect([last?.first.time, last?.second.time]).toEqual([1, 1]);
});

test("the scale of speed is a round number, and points are as large as their distance", () => {
  expect([0, 0.11, 0.83, 1, 3.2, 97].map(roundUp)).toEqual([1, 0.15, 1, 1, 4, 100]);
  expect(topSpeed(decoded(encoded(LEAVING), 30))).toBe(4);
  expect(keptSpacing(0.02, 8, 1)).toBeCloseTo(0.01, 12);
  expect(keptSpacing(0.02, 8, 8)).toBeCloseTo(0.02, 12);
});
