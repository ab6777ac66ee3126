/** Trajectories, read so that no more samples come than a picture shows, and none of them twice. */

import { type Job, type Trajectory, request } from "../../api/client";
import { hasEnded } from "../../parts/status";
import {
  type Columns,
  type Curves,
  type Poses,
  appended,
  curvesOf,
  posesOf,
  recordedTime,
  strideFor,
} from "./trajectories";

type Field = keyof Columns;

/** Most samples of a body, and of all bodies of a scene together. */
const MOST_SAMPLES = 2_000;
const MOST_OF_SCENE = 40_000;
/** Requests under way at a time. */
const AT_ONCE = 4;

const POSES: Field[] = ["time_s", "position_m", "orientation", "submerged_fraction"];
const CURVES: Field[] = [
  "time_s",
  "position_m",
  "velocity_m_s",
  "submerged_fraction",
  "flow_force_n",
  "wall_force_n",
  "body_force_n",
];

/** What has been read of a trajectory: one sample in `stride`, and whether its last one is among them. */
interface Read {
  stride: number;
  columns: Columns;
  isWhole: boolean;
}

/** Reader of a job's trajectories. While the job runs, it asks only for what is new. */
export class TrajectoryReader {
  private readonly kept = new Map<string, Read>();
  private attempt = 0;

  /** Poses of all bodies. */
  async readPoses(job: Job, signal: AbortSignal): Promise<Poses[]> {
    const bodies = job.scenario.bodies.length;
    const most = Math.min(MOST_SAMPLES, Math.floor(MOST_OF_SCENE / Math.max(1, bodies)));
    return inTurn(bodies, async (body) => posesOf(body, await this.read(job, body, POSES, most, signal)));
  }

  /** Curves of these bodies. */
  async readCurves(job: Job, bodies: readonly number[], signal: AbortSignal): Promise<Curves[]> {
    return inTurn(bodies.length, async (place) => {
      const body = bodies[place] ?? 0;
      return curvesOf(body, await this.read(job, body, CURVES, MOST_SAMPLES, signal));
    });
  }

  private async read(job: Job, body: number, fields: Field[], most: number, signal: AbortSignal): Promise<Columns> {
    if (job.attempt !== this.attempt) this.kept.clear();
    this.attempt = job.attempt;
    const isOver = hasEnded(job.status);
    const interval = job.scenario.sample_interval_s;
    // A run may end early: then its samples are fewer, and more of them have room.
    const stride = strideFor((isOver ? undefined : job.scenario.duration_s) ?? recordedTime(job), interval, most);
    const key = `${body} ${fields.length}`;
    const known = this.kept.get(key);
    if (known?.isWhole) return known.columns;
    const before = known?.stride === stride ? known.columns : {};
    const ask = (query: string) => readColumns(job.id, `body=${body}&fields=${fields.join(",")}&${query}`, signal);
    let columns = appended(before, await ask(`stride=${stride}${after(before, (stride - 0.5) * interval)}`));
    // The last sample need not be one in `stride`.
    if (isOver && stride > 1) columns = appended(columns, lastOf(await ask(after(columns, 0.5 * interval).slice(1))));
    signal.throwIfAborted();
    this.kept.set(key, { stride, columns, isWhole: isOver });
    return columns;
  }
}

async function readColumns(id: string, query: string, signal: AbortSignal): Promise<Columns> {
  const answer = await request(`v1/jobs/${id}/trajectory?${query}`, { signal });
  return ((await answer.json()) as Trajectory).columns;
}

/** Condition of a request for samples at least so long after the last known one. */
function after({ time_s = [] }: Columns, pause: number): string {
  const last = time_s.at(-1);
  return last === undefined ? "" : `&from_s=${last + pause}`;
}

function lastOf(columns: Columns): Columns {
  return Object.fromEntries(Object.entries(columns).map(([field, values]) => [field, values.slice(-1)]));
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
