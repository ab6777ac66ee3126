import { useEffect, useMemo, useState } from "preact/hooks";
import type { Job } from "../../api/client";
import { ProblemNotice } from "../../parts/problem-notice";
import { AerialView, SpeedScale } from "../aerial/aerial-view";
import type { AerialContent } from "../aerial/draw";
import { Clock } from "../playback/clock";
import { Transport } from "../playback/transport";
import { plotsOf } from "../plots/curves";
import { firstBodies } from "../plots/curves-section";
import { Plots } from "../plots/plots";
import { recordedTime } from "../records/trajectories";
import { useCurves, useFrames, usePoses } from "../records/use-records";
import type { Region } from "../region";
import { useContent } from "../replay";
import { useTheme } from "../use-theme";

/** Dashes of the second job's curves. */
const DASH = [6, 4];

/** Pictures of two jobs at the same time, and their curves over each other. */
export function PicturesComparison({ first, second }: { first: Job; second: Job }) {
  const clock = useMemo(() => new Clock(), [first.id, second.id]);
  const end = Math.max(recordedTime(first), recordedTime(second));
  useEffect(() => clock.setEnd(end), [clock, end]);
  useEffect(() => () => clock.pause(), [clock]);
  return (
    <>
      <section aria-labelledby="aerials">
        <h2 id="aerials">From above, at the same time</h2>
        <Transport clock={clock} />
        <Aerials first={first} second={second} clock={clock} />
      </section>
      <OverlaidCurves first={first} second={second} clock={clock} />
    </>
  );
}

/** A job with what a picture of it needs. */
interface Pictured {
  job: Job;
  name: string;
  content: AerialContent | undefined;
  problem: unknown;
}

function usePictured(job: Job, name: string): Pictured {
  const poses = usePoses(job);
  const flow = useFrames(job);
  return { job, name, content: useContent(job, poses.value, flow), problem: poses.problem ?? flow.problem };
}

function Aerials({ first, second, clock }: { first: Job; second: Job; clock: Clock }) {
  const [one, other] = [usePictured(first, "First"), usePictured(second, "Second")];
  const contents = useMemo(() => alike(one.content, other.content), [one.content, other.content]);
  const top = contents[0]?.topSpeed;
  return (
    <>
      {top !== undefined && <SpeedScale top={top} />}
      <div class="columns">
        {[one, other].map((each, place) => (
          <Aerial key={each.name} {...each} content={contents[place]} clock={clock} />
        ))}
      </div>
    </>
  );
}

/** Contents with the same scale of speed and, on the same ground, the same part of it. */
function alike(one: AerialContent | undefined, other: AerialContent | undefined): (AerialContent | undefined)[] {
  if (!one || !other) return [one, other];
  const topSpeed = Math.max(one.topSpeed, other.topSpeed);
  // Places in a channel and on a map, or on two maps, have nothing in common.
  if (one.scenario.terrain?.height_map !== other.scenario.terrain?.height_map)
    return [one, other].map((each) => ({ ...each, topSpeed }));
  const end = (of: (...values: number[]) => number, key: keyof Region, axis: 0 | 1 | 2) =>
    of(one.region[key][axis], other.region[key][axis]);
  const region: Region = {
    low: [end(Math.min, "low", 0), end(Math.min, "low", 1), end(Math.min, "low", 2)],
    high: [end(Math.max, "high", 0), end(Math.max, "high", 1), end(Math.max, "high", 2)],
  };
  return [one, other].map((content) => ({ ...content, topSpeed, region }));
}

function Aerial({ job, name, content, problem, clock }: Pictured & { clock: Clock }) {
  return (
    <div class="compared">
      <h3>
        {name}: {job.scenario.title || "Untitled"}
      </h3>
      {problem ? <ProblemNotice problem={problem} /> : null}
      {content ? <AerialView content={content} clock={clock} name={name} /> : <p class="quiet">Reading …</p>}
    </div>
  );
}

function OverlaidCurves({ first, second, clock }: { first: Job; second: Job; clock: Clock }) {
  const common = Math.min(first.scenario.bodies.length, second.scenario.bodies.length);
  const [body, setBody] = useState(() => firstBodies(first).find((body) => body < common) ?? 0);
  const chosen = common > 0 ? [body] : [];
  const one = useCurves(first, chosen);
  const other = useCurves(second, chosen);
  const { isDark } = useTheme();
  const plots = useMemo(() => {
    const jobs = [
      { curves: one.value ?? [], outcome: first.outcome, prefix: "First: " },
      { curves: other.value ?? [], outcome: second.outcome, prefix: "Second: ", dash: DASH },
    ];
    return plotsOf(jobs, isDark);
  }, [one.value, other.value, isDark]);
  if (common === 0) return null;
  const problem = one.problem ?? other.problem;
  return (
    <section aria-labelledby="overlaid">
      <h2 id="overlaid">Against time</h2>
      <p class="actions">
        <label class="inline">
          Body{" "}
          <select value={body} onChange={(event) => setBody(Number(event.currentTarget.value))}>
            {Array.from({ length: common }, (_, place) => (
              <option key={place} value={place}>
                {place}
              </option>
            ))}
          </select>
        </label>
        <span class="quiet">Solid: the first job. Dashed: the second.</span>
      </p>
      {problem ? <ProblemNotice problem={problem} /> : null}
      <Plots plots={plots} clock={clock} syncKey={`${first.id} ${second.id}`} />
    </section>
  );
}
