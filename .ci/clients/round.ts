// A client made by openapi-typescript takes a scenario from its submission to its results.

import createClient from "openapi-fetch";
import type { components, paths } from "./schema.js";

function check(holds: boolean, what: string): asserts holds {
  if (!holds) throw new Error(what);
}

const client = createClient<paths>({ baseUrl: process.argv[2] });
const scenario: components["schemas"]["Scenario"] = {
  title: "made by a generated client",
  channel: { inclination_deg: 40, incline_length_m: 1, runout_length_m: 1 },
  flow: { volume_m3: 0.002 },
  bodies: [{ shape: { cube: { side_m: 0.04 } } }],
  duration_s: 0.5,
  sample_interval_s: 0.05,
  flow_snapshots: 3,
};

const planned = await client.POST("/v1/plans", { body: scenario });
check((planned.data?.plan.cost.points ?? 0) > 0, "a plan");
const submitted = await client.POST("/v1/jobs", {
  params: { query: { label: ["client:typescript"] } },
  body: scenario,
});
check(submitted.data !== undefined, "a job");
let job = submitted.data;
const path = { id: job.id };
while (job.status === "accepted" || job.status === "running") {
  const answer = await client.GET("/v1/jobs/{id}", { params: { path, query: { wait: "10s" } } });
  check(answer.data !== undefined, "the job");
  job = answer.data;
}
check(job.status === "successful", job.status);
check((job.outcome?.bodies[0]?.displacement_m ?? 0) > 0, "a displacement");

// As JSON it is the document, in the other formats text or bytes.
const whole = await client.GET("/v1/jobs/{id}/trajectory", { params: { path } });
check(typeof whole.data === "object", "a document");
check(whole.data.columns.position_m?.length === 11, "11 samples");
const some = await client.GET("/v1/jobs/{id}/trajectory", {
  params: { path, query: { fields: ["time_s", "mode"] } },
});
check(typeof some.data === "object", "a document");
check(some.data.columns.position_m === undefined, "only the fields asked for");
check(some.data.columns.mode?.length === 11, "the mode");
const archive = await client.GET("/v1/jobs/{id}/trajectory.npz", {
  params: { path },
  parseAs: "arrayBuffer",
});
check((archive.data?.byteLength ?? 0) > 1000, "an archive");
const flow = await client.GET("/v1/jobs/{id}/flow", { params: { path, query: { time_s: 0.1 } } });
check((flow.data?.position_m.length ?? 0) > 0, "points of the flow");
const refused = await client.DELETE("/v1/jobs/{id}", { params: { path } });
check(refused.error?.type === "urn:scree:problem:job-ended", "a problem");
console.log("typescript: plan, submit, wait, trajectory, NPZ, flow, problem");
