import { useMemo, useState } from "preact/hooks";
import type { Job } from "../../api/client";
import { figure } from "../../parts/format";
import { ProblemNotice } from "../../parts/problem-notice";
import { bodyColour } from "../colours";
import type { Clock } from "../playback/clock";
import { useReadableTime } from "../playback/use-clock";
import { type Curves, valueAt } from "../records/trajectories";
import { useCurves } from "../records/use-records";
import { useTheme } from "../use-theme";
import { PLOTTED, plotsOf } from "./curves";
import { Plots } from "./plots";

/** Bodies shown at first: so many free ones. */
const AT_FIRST = 6;

/** Bodies that plots show at first: the first free ones, or else the first. */
export function firstBodies(job: Job): number[] {
  const all = job.scenario.bodies.map((body, place) => ({ place, isFree: !body.fixed && !body.motion }));
  const free = all.filter(({ isFree }) => isFree);
  return (free.length > 0 ? free : all).slice(0, AT_FIRST).map(({ place }) => place);
}

/** Curves of a job's bodies against time, and their values at the time of the replay. */
export function CurvesSection({ job, clock }: { job: Job; clock: Clock }) {
  const [bodies, setBodies] = useState(() => firstBodies(job));
  const { value: curves = [], problem } = useCurves(job, bodies);
  const { isDark } = useTheme();
  const plots = useMemo(() => plotsOf([{ curves, outcome: job.outcome }], isDark), [curves, job.outcome, isDark]);
  return (
    <section aria-labelledby="curves">
      <h2 id="curves">Against time</h2>
      {job.scenario.bodies.length > 1 && <BodyChoice job={job} bodies={bodies} setBodies={setBodies} />}
      {problem ? <ProblemNotice problem={problem} /> : null}
      <p class="quiet marks">▲ onset of motion, ● peak speed, ■ at rest. Forces are means since the sample before.</p>
      <Plots plots={plots} clock={clock} syncKey={job.id} />
      <ValuesTable curves={curves} clock={clock} />
    </section>
  );
}

interface Choice {
  job: Job;
  bodies: number[];
  setBodies: (bodies: number[]) => void;
}

function BodyChoice({ job, bodies, setBodies }: Choice) {
  const { isDark } = useTheme();
  const toggle = (body: number, isOn: boolean) =>
    setBodies(isOn ? [...bodies, body].sort((a, b) => a - b) : bodies.filter((other) => other !== body));
  return (
    <fieldset class="bodies">
      <legend>Bodies</legend>
      {job.scenario.bodies.map((body, place) => (
        <label key={place} class="inline">
          <input
            type="checkbox"
            checked={bodies.includes(place)}
            onChange={(event) => toggle(place, event.currentTarget.checked)}
          />
          <span class="swatch" style={{ background: bodyColour(place, isDark) }} />
          {place}
          {body.fixed ? " (fixed)" : ""}
        </label>
      ))}
    </fieldset>
  );
}

/** The curves' values at the time of the replay, for all who do not see them. */
function ValuesTable({ curves, clock }: { curves: Curves[]; clock: Clock }) {
  const time = useReadableTime(clock);
  const { isDark } = useTheme();
  if (curves.length === 0) return <p class="quiet">No body is chosen.</p>;
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label="Values at the time of the replay">
      <table class="values">
        <caption>At {time.toFixed(3)} s</caption>
        <thead>
          <tr>
            <th>Body</th>
            {PLOTTED.map(({ key, name, unit }) => (
              <th key={key} class="number">
                {name} <span class="unit">[{unit}]</span>
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {curves.map((body) => (
            <tr key={body.body}>
              <th scope="row">
                <span class="swatch" style={{ background: bodyColour(body.body, isDark) }} />
                {body.body}
              </th>
              {PLOTTED.map(({ key }) => (
                <td key={key} class="number">
                  {figure(valueAt(body.time, body[key], time))}
                </td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
