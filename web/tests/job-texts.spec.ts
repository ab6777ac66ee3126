import { expect, test } from "@playwright/test";
import { execFileSync } from "node:child_process";
import { differencesOf } from "../src/job/compare/differences";
import { auditOf, verdictOf } from "../src/job/outcome/audit";
import { intervalText, overlap } from "../src/job/outcome/quantities";
import { bodySentence } from "../src/job/outcome/sentences";
import { curvesOf, poseAt, sampleAt, strideFor, valueAt } from "../src/job/records/trajectories";
import { multiples, niceStep } from "../src/parts/round-values";
import { Pace } from "../src/job/scene/pace";
import { curlRecipe, pythonLiteral, pythonRecipe } from "../src/job/take/recipes";

type Told = Parameters<typeof bodySentence>[1];

const MOVED = {
  first_contact_time_s: 0.4,
  onset_time_s: 0.412,
  peak_speed_m_s: 1.623,
  peak_speed_time_s: 0.62,
  stop_time_s: 0.94,
  displacement_m: 0.4131,
  burial_depth_m: 0,
} as Told;

test("an outcome is told in sentences", () => {
  expect(bodySentence(0, MOVED, 0.371)).toBe(
    "Body 0 began to move at 0.412 s, reached 1.62 m/s at 0.62 s and came to rest at 0.94 s, 0.413 m from its start, 37 % submerged.",
  );
  expect(bodySentence(1, { ...MOVED, stop_time_s: null })).toContain(
    "and still moved when the run ended, 0.413 m from its start.",
  );
  expect(bodySentence(2, { ...MOVED, burial_depth_m: 0.012 }, 1)).toContain(", 12 mm below the surface of the flow.");
  expect(bodySentence(3, { ...MOVED, onset_time_s: null })).toBe(
    "Body 3 was reached by the flow at 0.4 s and did not move.",
  );
  expect(bodySentence(4, { ...MOVED, onset_time_s: null, first_contact_time_s: null })).toBe(
    "Body 4 was not reached by the flow and did not move.",
  );
  expect(bodySentence(5, { ...MOVED, onset_time_s: null, first_contact_time_s: null }, 0, false)).toBe(
    "Body 5 did not move.",
  );
});

test("the audit doubts from the documented bounds on", () => {
  const conservation = {
    mass_error: 0,
    points_lost: 0,
    momentum_residual: 9e-9,
    angular_momentum_residual: 9e-9,
    energy_residual: 0,
    max_overlap_ratio: 0.29,
    max_body_overlap_ratio: 0.006,
    penetration_corrections: 0,
    angular_momentum_from_shifting: 0,
    points_outflow: 3,
  };
  const outcome = (changes: Partial<typeof conservation>) =>
    ({ conservation: { ...conservation, ...changes }, bodies: [] }) as unknown as Parameters<typeof auditOf>[0];
  expect(verdictOf(auditOf(outcome({}), "channel"))).toMatch(/^Yes/);
  for (const changes of [
    { mass_error: -1e-9 },
    { points_lost: 1 },
    { momentum_residual: 1e-6 },
    { energy_residual: 0.02 },
    { max_overlap_ratio: 1 },
    { max_body_overlap_ratio: 0.9 },
  ]) {
    const figures = auditOf(outcome(changes), "channel");
    expect(figures.filter(({ isFine }) => isFine === false).length, JSON.stringify(changes)).toBe(1);
    expect(verdictOf(figures)).toMatch(/^With care/);
  }
});

test("intervals are told by their ends, and compared where both are closed", () => {
  const interval = (low: number | null, high: number | null) => ({
    low,
    high,
    value: 1,
    order: null,
    basis: "scattered" as const,
  });
  expect([interval(1, 2), interval(1, null), interval(null, null)].map((one) => intervalText(one, 4))).toEqual([
    "1 to 2",
    "from 1",
    "none",
  ]);
  expect(overlap(interval(1, 2), interval(1.5, 3))).toBe(true);
  expect(overlap(interval(1, 2), interval(2.5, 3))).toBe(false);
  expect(overlap(interval(1, null), interval(2.5, 3))).toBeUndefined();
});

test("differences of documents are named by JSON pointers", () => {
  const first = { a: { "b/c": 1, same: [1, 2] }, bodies: [{ x: 1 }], flow: null };
  const second = { a: { "b/c": 2, same: [1, 2] }, bodies: [{ x: 1 }, { x: 2 }], flow: { volume: 1 } };
  expect(differencesOf(first, second)).toEqual([
    { pointer: "/a/b~1c", first: 1, second: 2 },
    { pointer: "/bodies/1", first: undefined, second: { x: 2 } },
    { pointer: "/flow", first: null, second: { volume: 1 } },
  ]);
});

test("recipes hold any title, and never a token", () => {
  const scenario = { title: `it's "5 $HOME" \\ \`x\` é`, flow: null, bodies: [], fixed: true } as unknown as Parameters<
    typeof curlRecipe
  >[1];
  const curl = curlRecipe("http://127.0.0.1:1/", scenario, true);
  expect(curl).toContain(`"Authorization: Bearer $SCREE_TOKEN"`);
  const echoed = execFileSync("sh", ["-c", curl.replace(/^curl/, "printf '%s\\n'")], {
    env: { SCREE_TOKEN: "t" },
  }).toString();
  expect(echoed).toContain(JSON.stringify(scenario));
  const program = `import json; print(json.dumps(${pythonLiteral(scenario)}))`;
  expect(JSON.parse(execFileSync("python3", ["-c", program]).toString())).toEqual(scenario);
  expect(pythonRecipe("http://127.0.0.1:1/", scenario, true)).toContain(`os.environ["SCREE_TOKEN"]`);
  expect(pythonRecipe("http://127.0.0.1:1/", scenario, false)).not.toContain("token");
});

test("values and poses lie between samples", () => {
  expect([-1, 0, 0.5, 2, 9].map((time) => sampleAt([0, 1, 2], time))).toEqual([0, 0, 0, 2, 2]);
  expect([0.5, 5].map((time) => valueAt([0, 1, 2], [0, 10, 20], time))).toEqual([5, 20]);
  const half = Math.SQRT1_2;
  // The second quaternion is the same turn with its sign changed: the way is the shorter one.
  const poses = {
    body: 0,
    time: [0, 1],
    position: [
      [0, 0, 0],
      [2, 0, 0],
    ] as [number, number, number][],
    orientation: [
      [1, 0, 0, 0],
      [-half, 0, 0, -half],
    ] as [number, number, number, number][],
    lastSubmergence: 0,
  };
  const pose = poseAt(poses, 0.5);
  expect(pose?.position).toEqual([1, 0, 0]);
  expect(pose?.orientation[0]).toBeCloseTo(Math.cos(Math.PI / 8), 9);
  expect(pose?.orientation[3]).toBeCloseTo(Math.sin(Math.PI / 8), 9);
  expect(poseAt({ ...poses, time: [], position: [], orientation: [] }, 0)).toBeUndefined();
});

test("curves are the sizes of vectors, and as few samples as are seen", () => {
  const curves = curvesOf(0, {
    time_s: [0, 1],
    position_m: [
      [1, 0, 0],
      [4, 4, 9],
    ],
    velocity_m_s: [
      [0, 0, 0],
      [0, 3, 4],
    ],
    wall_force_n: [
      [0, 0, 1],
      [0, 0, 1],
    ],
    body_force_n: [
      [0, 0, 0],
      [0, 0, -1],
    ],
  });
  expect([curves.displacement, curves.speed, curves.contactForce]).toEqual([
    [0, 5],
    [0, 5],
    [1, 0],
  ]);
  expect([strideFor(1, 0.01, 2000), strideFor(40, 0.01, 2000), strideFor(3600, 0.01, 2000)]).toEqual([1, 3, 181]);
});

test("grid lines are at round numbers", () => {
  expect([niceStep(3, 8), niceStep(0.5, 8), niceStep(1000, 8)]).toEqual([0.5, 0.1, 200]);
  expect(multiples(0.1, -0.2, 0.3)).toEqual([-0.2, -0.1, 0, 0.1, 0.2, 0.3]);
});

test("slow pictures get fewer pixels, unless those do not help", () => {
  const filled = new Pace(2);
  let now = 0;
  for (let k = 0; k < 100; k += 1) filled.note((now += 20 + 60 * filled.ratio));
  expect(filled.ratio).toBeLessThan(1);
  const busy = new Pace(1);
  now = 0;
  for (let k = 0; k < 60; k += 1) busy.note((now += 70));
  expect(busy.ratio).toBe(1);
});
