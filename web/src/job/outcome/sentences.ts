/** Outcomes as sentences. */

import type { Job, Outcome, Schemas } from "../../api/client";
import { figure, length } from "../../parts/format";
import { groundOf } from "../../scenario/ground";

type BodyOutcome = Schemas["BodyOutcome"];

/** Most bodies that have a sentence each; of more the table tells. */
const MOST_SENTENCES = 8;

/** What happened, in sentences: to each body, with its last submergence (0..1) once known, and to the flow. */
export function sentencesOf(job: Job, submergence: readonly number[] = []): string[] {
  const { outcome, scenario } = job;
  if (!outcome) return [];
  const bodies = outcome.bodies.flatMap((body, place) => {
    const given = scenario.bodies[place];
    if (given?.fixed) return [];
    return [
      given?.motion
        ? `Body ${place} moved as prescribed, ${figure(body.displacement_m)} m from its start.`
        : bodySentence(place, body, submergence[place], scenario.flow !== null),
    ];
  });
  const told = bodies.slice(0, MOST_SENTENCES);
  const more = bodies.length - told.length;
  if (more > 0) told.push(`${more} more bodies are in the table below.`);
  return [...told, ...(groundOf(scenario) === "channel" ? inChannel(outcome) : onTerrain(outcome))];
}

/** What happened to a free body. */
export function bodySentence(place: number, body: BodyOutcome, submergence = 0, hasFlow = true): string {
  if (body.onset_time_s === null) return `Body ${place} ${hasFlow ? stoodStill(body) : "did not move"}.`;
  const parts = [`began to move at ${figure(body.onset_time_s)} s`];
  if (body.peak_speed_time_s !== null) {
    parts.push(`reached ${figure(body.peak_speed_m_s)} m/s at ${figure(body.peak_speed_time_s)} s`);
  }
  const distance = `${figure(body.displacement_m)} m from its start`;
  const end =
    body.stop_time_s === null
      ? `still moved when the run ended, ${distance}`
      : `came to rest at ${figure(body.stop_time_s)} s, ${distance}`;
  return `Body ${place} ${parts.join(", ")} and ${end}${buried(body, submergence)}.`;
}

function stoodStill(body: BodyOutcome): string {
  if (body.first_contact_time_s === null) return "was not reached by the flow and did not move";
  return `was reached by the flow at ${figure(body.first_contact_time_s)} s and did not move`;
}

function buried({ burial_depth_m: depth }: BodyOutcome, submergence: number): string {
  if (depth > 0) return `, ${length(depth, 2)} below the surface of the flow`;
  return submergence > 0.005 ? `, ${figure(100 * submergence, 2)} % submerged` : "";
}

function inChannel({ flow }: Outcome): string[] {
  if (flow.front_m === null || flow.runout_m === null) return [];
  const side = flow.front_m < 0 ? "upstream" : "downstream";
  const front = `The front of the flow came ${figure(Math.abs(flow.front_m))} m ${side} of the foot of the incline, a run-out of ${figure(flow.runout_m)} m`;
  const out = flow.outflow_mass_kg > 0 ? `; ${figure(flow.outflow_mass_kg)} kg left through the open end` : "";
  return [`${front}${out}.`];
}

function onTerrain({ flow }: Outcome): string[] {
  const out = flow.outflow_mass_kg > 0 ? `${figure(flow.outflow_mass_kg)} kg of the flow left the map` : "";
  if (flow.front_m === null || flow.runout_m === null) return out ? [`${out}, so that its front is not known.`] : [];
  const front = `The front of the flow came ${figure(flow.front_m)} m from the middle of its release, a run-out of ${figure(flow.runout_m)} m`;
  return [`${front}${out && `; ${out}`}.`];
}
