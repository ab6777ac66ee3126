/** Trajectories, read so that no more samples come than a picture shows. */

import { type Job, type Trajectory, request } from "../../api/client";
import { type Columns, type Curves, type Poses, curvesOf, posesOf, recordedTime, strideFor } from "./trajectories";

type Field = keyof Columns;

/** Most samples of a body, and of all bodies of a scene together. */
const MOST_SAMPLES = 2_000;
const MOST_OF_SCENE = 40_000;
/** Requests under way at a time. */
const AT_ONCE = 4;

/** Poses of all bodies. */
export async function readPoses(job: Job, signal: AbortSignal): Promise<Poses[]> {
  const bodies = job.scenario.bodies.length;
  const most = Math.min(MOST_SAMPLES, Math.floor(MOST_OF_SCENE / Math.max(1, bodies)));
  const fields: Field[] = ["time_s", "position_m", "orientation", "submerged_fraction"];
  return inTurn(bodies, async (body) => posesOf(body, await read(job, body, fields, most, signal)));
}

/** Curves of one body. */
export async function readCurves(job: Job, body: number, signal: AbortSignal): Promise<Curves> {
  const fields: Field[] = [
    "time_s",
    "position_m",
    "velocity_m_s",
    "submerged_fraction",
    "flow_force_n",
    "wall_force_n",
    "body_force_n",
  ];
  return curvesOf(body, await read(job, body, fields, MOST_SAMPLES, signal));
}

async function read(job: Job, body: number, fields: Field[], most: number, signal: AbortSignal): Promise<Columns> {
  const stride = strideFor(recordedTime(job), job.scenario.sample_interval_s, most);
  const query = `body=${body}&stride=${stride}&fields=${fields.join(",")}`;
  const answer = await request(`v1/jobs/${job.id}/trajectory?${query}`, { signal });
  return ((await answer.json()) as Trajectory).columns;
}

/** Results for 0, 1, … in order, a few asked for at a time. */
async function inTurn<T>(count: number, ask: (place: number) => Promise<T>): Promise<T[]> {
  const results = new Array<T>(count);
  let next = 0;
  const work = async () => {
    while (next < count) {
      const place = next++;
      results[place] = await ask(place);
    }
  };
  await Promise.all(Array.from({ length: Math.min(AT_ONCE, count) }, work));
  return results;
}
