/** Small studies for the tests of the page. */

import { QUICK, type Service, expect } from "./service";

/** A scene of a member, computed within a fraction of a second. */
export const SCENE = {
  ...QUICK,
  bodies: [{ shape: { cube: { side_m: 0.03 } }, position: { downstream_m: 0.03 } }],
  numerics: { cell_size_m: 0.02 },
};

const INPUTS = [
  { pointer: "/channel/base_friction", distribution: { uniform: { from: 0.3, to: 0.5 } } },
  { pointer: "/flow/volume_m3", distribution: { lognormal: { median: 0.0006, p95: 0.0008 } } },
  { pointer: "/bodies/0/position/lateral_m", distribution: { uniform: { from: -0.02, to: 0.02 } } },
];

/** A question of every kind. */
export const QUESTIONS = [
  { rest: { body: 0, regions: [0.5, 0.9] } },
  { exceeds: { quantity: "displacement_m", body: 0, thresholds: [0.05, 0.1] } },
  { buried: { body: 0, deeper_than_m: 0 } },
  { quantiles: { quantity: "peak_speed_m_s", body: 0, probabilities: [0.5] } },
  { mean: { quantity: "runout_m" } },
  { sensitivity: { quantity: "displacement_m", body: 0 } },
];

/** A small study. */
export const STUDY = {
  title: "Small cube",
  scenario: SCENE,
  inputs: INPUTS,
  design: { sobol: { members: 32, seed: 1 } },
  questions: QUESTIONS,
};

/** Submits a study, and waits for its end. */
export async function finished(service: Service, study: unknown): Promise<string> {
  const { id } = await service.post<{ id: string }>("/v1/studies", study);
  await expect
    .poll(async () => (await service.get<{ status: string }>(`/v1/studies/${id}`)).status, { timeout: 50_000 })
    .toBe("successful");
  return id;
}
