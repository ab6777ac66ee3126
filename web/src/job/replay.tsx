import { useMemo, useState } from "preact/hooks";
import type { Job } from "../api/client";
import { figure } from "../parts/format";
import { lazily } from "../parts/lazily";
import { ProblemNotice } from "../parts/problem-notice";
import { groundOf } from "../scenario/ground";
import { AerialView, SpeedScale } from "./aerial/aerial-view";
import type { AerialContent } from "./aerial/draw";
import { keptSpacing, topSpeed } from "./flow/frames";
import type { Clock } from "./playback/clock";
import { Transport } from "./playback/transport";
import type { Poses } from "./records/trajectories";
import type { Frames } from "./records/use-records";
import { regionOf } from "./region";

const SceneView = lazily(() => import("./scene/scene-view").then((part) => part.SceneView));

/** What pictures of a job show, once its records are there. */
export function useContent(job: Job | undefined, poses: Poses[] | undefined, flow: Frames): AerialContent | undefined {
  return useMemo(() => {
    if (!job || !poses) return undefined;
    const frames = flow.frames ?? [];
    const { scenario } = job;
    const cellSize =
      job.outcome?.cost.cell_size_m ?? job.plan?.cost.cell_size_m ?? scenario.numerics?.cell_size_m ?? 0.01;
    // A job's scenario has every default; its type is that of one that is submitted.
    const perCell = scenario.numerics?.points_per_cell ?? 8;
    return {
      scenario,
      poses,
      frames,
      spacing: (thinning: number) => keptSpacing(cellSize, perCell, thinning),
      topSpeed: topSpeed(frames),
      region: regionOf(scenario, poses, frames),
    };
  }, [job?.id, poses, flow.frames, job?.outcome]);
}

/** Replay of a job in three dimensions or from above. */
export function Replay({ content, flow, clock }: { content: AerialContent; flow: Frames; clock: Clock }) {
  const [isFlat, setIsFlat] = useState(false);
  const [hasFailed, setHasFailed] = useState(false);
  return (
    <section aria-labelledby="replay">
      <h2 id="replay">Replay</h2>
      <div class="replay-head">
        <div class="choice" role="group" aria-label="View">
          <button
            type="button"
            aria-pressed={!isFlat && !hasFailed}
            disabled={hasFailed}
            onClick={() => setIsFlat(false)}
          >
            3D
          </button>
          <button type="button" aria-pressed={isFlat || hasFailed} onClick={() => setIsFlat(true)}>
            From above
          </button>
        </div>
        {content.frames.length > 0 && <SpeedScale top={content.topSpeed} />}
      </div>
      {hasFailed && (
        <p class="notice warning">This browser shows no 3D pictures (WebGL), so here is the view from above.</p>
      )}
      {isFlat || hasFailed ? (
        <AerialView content={content} clock={clock} name="Replay" />
      ) : (
        <SceneView content={content} clock={clock} fail={() => setHasFailed(true)} />
      )}
      <Transport clock={clock} />
      {groundOf(content.scenario) === "terrain" && (
        <p class="quiet">
          The terrain itself is not drawn. The frame holds all that happens, in metres east, north and up from the
          south-western corner of the height map.
        </p>
      )}
      <FlowNote flow={flow} content={content} />
    </section>
  );
}

function FlowNote({ flow, content }: { flow: Frames; content: AerialContent }) {
  if (flow.problem) return <ProblemNotice problem={flow.problem} />;
  if (content.scenario.flow === null) return <p class="quiet">This scenario has no flow.</p>;
  if (!flow.frames)
    return (
      <p class="quiet">
        {flow.of > 0 ? `Reading the flow: ${flow.read} of ${flow.of} instants …` : "Reading the flow …"}
      </p>
    );
  const [first] = flow.frames;
  if (!first) return <p class="quiet">No instants of the flow are stored.</p>;
  if (flow.frames.every(({ kept }) => kept === 0)) return <p class="quiet">The flow has no material points.</p>;
  const kept = first.thinning > 1 ? `; one in ${first.thinning} of the ${first.points} material points is kept` : "";
  return (
    <p class="quiet">
      {flow.frames.length === 1
        ? `The flow is stored at one instant, ${figure(first.time)} s`
        : `The flow is stored at ${flow.frames.length} instants, between which the points are interpolated`}
      {kept}.
    </p>
  );
}
