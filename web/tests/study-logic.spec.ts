import { expect, test } from "@playwright/test";
import { readFile } from "node:fs/promises";
import type { Contract } from "../src/api/client";
import { lowerBound, upperBound } from "../src/study/binomial";
import { sentence, shape } from "../src/study/distributions";
import { type ListedMember, isDraw, quantityOf, restingPlace } from "../src/study/documents";
import { growthOf } from "../src/study/enlargement";
import { curve, exceeding } from "../src/study/exceedance";
import { labelsOf, surroundingsOf } from "../src/study/map-frame";
import { columns, sorted } from "../src/study/members";
import { unitOfKey } from "../src/parts/words";
import { placeName } from "../src/study/names";
import { rangeOfValue } from "../src/parts/text-area";
import { mapScale, onMap, rangeOf, roundValues } from "../src/study/scales";
import { directionOf, tornado } from "../src/study/sensitivity";
import { Throttle } from "../src/parts/throttle";

function member(number: number, values: unknown[], displacement?: number): ListedMember {
  const bodies = [
    {
      rest_m: [0.1 * number, 0.01, 0],
      moving: number === 3,
      hit: true,
      buried_m: 0,
      quantities: displacement === undefined ? {} : { displacement_m: displacement },
    },
  ];
  return {
    level: 0,
    member: number,
    values,
    job: `job-${number}`,
    status: "successful",
    outcome: { finished: { quantities: { runout_m: number }, bodies } },
  };
}

test("bounds of probabilities are those of Clopper and Pearson", () => {
  expect(lowerBound(0, 10)).toBe(0);
  expect(upperBound(0, 10)).toBeCloseTo(1 - 0.025 ** 0.1, 9);
  expect(lowerBound(5, 10)).toBeCloseTo(0.187086, 5);
  expect(upperBound(5, 10)).toBeCloseTo(0.812914, 5);
  // Figures of the service for 24 of 64 members.
  expect(lowerBound(24, 64)).toBeCloseTo(0.25704892, 7);
  expect(upperBound(24, 64)).toBeCloseTo(0.50492354, 7);
});

test("an exceedance curve falls from 1 to 0 in steps at the values", () => {
  const steps = curve([3, 1, 2, 2], 0);
  expect(steps.map(({ threshold, estimate }) => [threshold, estimate])).toEqual([
    [1, 1],
    [1, 0.75],
    [2, 0.25],
    [3, 0],
  ]);
  expect(curve([], 5)).toEqual([]);
  const many = curve(
    Array.from({ length: 5000 }, (_, place) => place),
    0,
  );
  expect(many.length).toBeLessThan(500);
  expect(many.at(-1)?.estimate).toBe(0);
});

test("members of unknown value widen both bounds", () => {
  const [sure, unsure] = [exceeding([1, 2, 3, 4], 0, 2.5), exceeding([1, 2, 3, 4], 4, 2.5)];
  expect(sure.estimate).toBe(0.5);
  expect(unsure.estimate).toBe(0.5);
  expect(unsure.lower).toBe(lowerBound(2, 8));
  expect(unsure.upper).toBe(upperBound(6, 8));
});

test("distributions are told as sentences with units", () => {
  expect(sentence({ uniform: { from: 0.3, to: 0.45 } }, "")).toBe("Between 0.3 and 0.45, each value as likely.");
  expect(sentence({ lognormal: { median: 0.008, p95: 0.01 } }, "m³")).toBe(
    "Lognormal with median 0.008 m³; 19 of 20 draws are below 0.01 m³.",
  );
  expect(sentence({ normal: { mean: 1, sd: 0.2, truncate: { from: 0.5, to: 2 } } }, "m")).toBe(
    "Normal with mean 1 m and standard deviation 0.2 m, within 0.5 m and 2 m.",
  );
  expect(
    sentence(
      {
        choice: {
          values: [
            { value: "wet", weight: 3 },
            { value: 2, weight: 1 },
          ],
        },
      },
      "",
    ),
  ).toBe('One of "wet" (75 %), 2 (25 %).');
  expect(sentence({ list: { values: [1, 2, 3, 4, 5, 6] } }, "°")).toBe(
    "One of 6 numbers from 1 ° to 6 °, each as likely.",
  );
});

test("densities have their peak where the distribution has its mode", () => {
  const peak = (heights: { x: number; y: number }[]) =>
    heights.reduce((best, point) => (point.y > best.y ? point : best)).x;
  expect(peak(shape({ normal: { mean: 2, sd: 0.1 } })?.heights ?? [])).toBeCloseTo(2, 2);
  const lognormal = shape({ lognormal: { median: 1, p95: 2 } })?.heights ?? [];
  expect(peak(lognormal)).toBeCloseTo(Math.exp(-((Math.log(2) / 1.645) ** 2)), 1);
  expect(shape({ choice: { values: [{ value: "wet", weight: 1 }] } })).toBeUndefined();
});

test("names of inputs and units come from the keys", () => {
  expect(placeName("/bodies/0/position/lateral_m")).toBe("body 0, position, lateral");
  expect(placeName("/channel/base_friction")).toBe("channel, base friction");
  expect([
    unitOfKey("peak_speed_m_s"),
    unitOfKey("volume_m3"),
    unitOfKey("yaw_deg"),
    unitOfKey("base_friction"),
  ]).toEqual(["m/s", "m³", "°", ""]);
});

test("a map has equal scales along both axes", () => {
  for (const [x, y] of [
    [
      [0, 1],
      [-0.1, 0.1],
    ],
    [
      [0, 0.1],
      [-2, 2],
    ],
  ] as [[number, number], [number, number]][]) {
    const scale = mapScale(x, y, 600);
    expect((scale.x[1] - scale.x[0]) / scale.width).toBeCloseTo((scale.y[1] - scale.y[0]) / scale.height, 9);
    expect(scale.x[0]).toBeLessThanOrEqual(x[0]);
    expect(scale.y[1]).toBeGreaterThanOrEqual(y[1]);
  }
  const scale = mapScale([0, 1], [-0.25, 0.25], 400);
  expect(onMap(scale, [0, 0.25])).toEqual([0, 0]);
  expect(onMap(scale, [1, -0.25])).toEqual([400, 200]);
});

test("round values lie in their range, and ranges hold their values", () => {
  expect(roundValues([0, 1], 4)).toEqual([0, 0.5, 1]);
  expect(roundValues([-0.13, 0.52], 6)).toEqual([0, 0.2, 0.4]);
  expect(rangeOf([1, 3], 0.5)).toEqual([0, 4]);
  expect(rangeOf([], 0.1)).toEqual([0, 1]);
  expect(rangeOf([2], 0.1)).toEqual([1.5, 2.5]);
});

test("labels of regions keep apart, and what can't be placed is left to the legend", () => {
  const ring = (radius: number): [number, number][] =>
    Array.from({ length: 24 }, (_, turn) => [radius * Math.cos(turn / 4), radius * Math.sin(turn / 4)]);
  const labels = labelsOf([50, 80, 84].map((radius) => ({ text: String(radius), corners: ring(radius) })));
  expect(labels.map(({ text }) => text)).toEqual(["50", "80", "84"]);
  expect(
    labelsOf(Array.from({ length: 9 }, () => ({ text: "x", corners: [[1, 1]] as [number, number][] }))),
  ).toHaveLength(1);
});

test("the surroundings of a map are the channel and the body's start", async () => {
  const { schemas } = (JSON.parse(await readFile("../api/openapi.json", "utf8")) as Contract).components;
  const channel = { inclination_deg: 40, incline_length_m: 1, runout_length_m: 2 };
  expect(surroundingsOf({ channel, bodies: [{ shape: { cube: { side_m: 0.04 } } }] }, 0, schemas)).toEqual({
    ground: "channel",
    channel: { halfWidth: 0.1, ends: [-1, 2], hasFoot: true },
    start: [0.04, 0],
  });
  expect(surroundingsOf({ channel, bodies: [{ shape: { ball: {} } }] }, 0, schemas)?.start).toBeUndefined();
  const askew = [{ shape: { ball: { radius_m: 0.02 } }, position: { downstream_m: 1, lateral_m: -0.1 } }];
  expect(surroundingsOf({ channel, bodies: askew }, 0, schemas)?.start).toEqual([1, -0.1]);
  expect(surroundingsOf({}, 0, schemas)).toBeUndefined();
  const bodies = [{ position: { east_m: 6.5, north_m: 6 } }];
  const onTerrain = (coordinates: string) => surroundingsOf({ terrain: { coordinates }, bodies }, 0, schemas);
  expect(onTerrain("local")).toEqual({ ground: "terrain", channel: undefined, start: [6.5, 6] });
  expect(onTerrain("map")?.start).toBeUndefined();
});

test("only draws of the inputs make probabilities", () => {
  expect([0, 1, 2, 3, 4].map((index) => isDraw({ saltelli: { base_members: 2, seed: 1 } }, index, 2))).toEqual([
    true,
    true,
    false,
    false,
    true,
  ]);
  expect(isDraw({ morris: { trajectories: 2, levels: 4, seed: 1 } }, 0, 2)).toBe(false);
  expect(isDraw({ sobol: { members: 2, seed: 1 } }, 1, 2)).toBe(true);
});

test("quantities of members are those of a body or of the run", () => {
  expect(quantityOf(member(2, [], 0.5), "displacement_m", 0)).toBe(0.5);
  expect(quantityOf(member(2, []), "displacement_m", 0)).toBeUndefined();
  expect(quantityOf(member(2, []), "runout_m", null)).toBe(2);
  expect(quantityOf(member(2, []), "rest_x_m", 0)).toBe(0.2);
  expect(restingPlace(member(2, []), 0)).toEqual([0.2, 0.01]);
  expect(restingPlace(member(3, []), 0)).toBeUndefined();
});

test("members are sorted by a column, those without a value last", () => {
  const study = {
    scenario: {},
    inputs: [{ pointer: "/channel/base_friction" }],
    design: { sobol: { members: 4, seed: 1 } },
    questions: [{ mean: { quantity: "displacement_m", body: 0 } }],
  };
  const column = columns(study).find(({ title }) => title.includes("displacement"));
  if (!column) throw new Error("no such column");
  const members = [member(0, [1], 0.3), member(1, [2]), member(2, [3], 0.1)];
  expect(sorted(members, column, false).map(({ member }) => member)).toEqual([2, 0, 1]);
  expect(sorted(members, column, true).map(({ member }) => member)).toEqual([0, 2, 1]);
});

test("the largest sensitivity is on top, with its direction", () => {
  const estimate = (value: number) => ({ value, lower: value - 0.1, upper: value + 0.1 });
  const inputs = [0.1, 0.7].map((value) => ({ first_order: estimate(value), total: estimate(value + 0.05) }));
  const { rows, axis } = tornado({ sobol: { inputs, rows: 8, rows_left_out: 0 } }, ["unclear", "falls"]);
  expect(rows.map(({ input, direction }) => [input, direction])).toEqual([
    [1, "falls"],
    [0, "unclear"],
  ]);
  expect(axis).toBe("share");
  const moment = (value: number) => ({ value, standard_error: 0.01 });
  const effects = [
    { mean: moment(-0.2), mean_size: moment(0.2), deviation: moment(0.05), effects: 6, effects_left_out: 0 },
  ];
  expect(tornado({ elementary: { inputs: effects } }, []).rows[0]?.direction).toBe("falls");
});

test("a direction is clear only beyond chance", () => {
  const pairs = Array.from({ length: 20 }, (_, place) => [place, -place] as const);
  expect(directionOf(pairs)).toBe("falls");
  expect(directionOf(pairs.map(([x]) => [x, x * x] as const))).toBe("rises");
  expect(directionOf(pairs.map(([x]) => [x, x % 2] as const))).toBe("unclear");
  expect(directionOf(pairs.map(([x]) => [x, 1] as const))).toBe("unclear");
});

test("a pointer leads to its place in the text", () => {
  const text = '{"a": [1, {"b/c": "x\\"}", "d": {}}], "e": -2.5e3}';
  const at = (pointer: string) => text.slice(...rangeOfValue(text, pointer));
  expect(at("/a/1/b~1c")).toBe('"x\\"}"');
  expect(at("/a/0")).toBe("1");
  expect(at("/e")).toBe("-2.5e3");
  expect(at("/a/1/d/missing")).toBe("{");
  expect(at("")).toBe(text);
  expect(rangeOfValue('{"a": [', "/a/0")).toEqual([0, 1]);
});

test("designs grow where the service can enlarge them", () => {
  const growth = growthOf({ sobol: { members: 64, seed: 3 } });
  expect(growth?.to(growth.next)).toEqual({ sobol: { members: 128, seed: 3 } });
  expect(growthOf({ latin_hypercube: { members: 10, seed: 1 } })).toBeUndefined();
});

test("a throttle keeps its pause, and forgets no last wish", async () => {
  let calls = 0;
  const throttle = new Throttle(async () => (calls += 1), 200);
  for (let ask = 0; ask < 5; ask += 1) {
    throttle.ask();
    await new Promise((resume) => setTimeout(resume, 20));
  }
  expect(calls).toBe(1);
  await expect.poll(() => calls).toBe(2);
  throttle.ask();
  throttle.end();
  await new Promise((resume) => setTimeout(resume, 300));
  expect(calls).toBe(2);
});
