import { figure } from "../parts/format";
import { unitOfKey } from "../parts/words";
import type { Study } from "./documents";
import { DensityCurve } from "./density-curve";
import { sentence } from "./distributions";
import { lastKey, placeName } from "./names";
import { percent } from "./percent";

/** Uncertain inputs, each with its distribution as a sentence and as a curve. */
export function InputsTable({ study }: { study: Study }) {
  return (
    <section aria-labelledby="inputs-title">
      <h2 id="inputs-title">Uncertain inputs</h2>
      <ul class="inputs">
        {study.inputs.map(({ pointer, distribution }) => (
          <li key={pointer} class="card">
            <strong>{placeName(pointer)}</strong> <code>{pointer}</code>
            <p>{sentence(distribution, unitOfKey(lastKey(pointer)))}</p>
            <DensityCurve distribution={distribution} />
          </li>
        ))}
      </ul>
      {(study.correlations ?? []).map(({ inputs, rank }) => (
        <p key={String(inputs)}>
          {inputs.map((input) => placeName(study.inputs[input]?.pointer ?? "")).join(" and ")} have a rank correlation
          of {figure(rank, 2)}.
        </p>
      ))}
      <p class="quiet">{designSentence(study)}</p>
    </section>
  );
}

/** Sentence about a study's design, levels and stopping rule. */
export function designSentence({ design, stop, accuracy }: Study): string {
  const sentences = [kindOfDesign(design)];
  if (stop) {
    const { region, area_changes_less_than, max_members } = stop;
    sentences.push(
      `It is doubled until the area of the ${percent(region)} region changes by less than ${percent(area_changes_less_than)}, or there are ${max_members} members.`,
    );
  }
  if (accuracy)
    sentences.push(`Members and finer levels are added until the mean is certain to ±${percent(accuracy.target)}.`);
  return sentences.join(" ");
}

function kindOfDesign(design: Study["design"]): string {
  if ("sobol" in design) return `Design: ${design.sobol.members} Sobol' points, seed ${design.sobol.seed}.`;
  if ("latin_hypercube" in design)
    return `Design: Latin hypercube of ${design.latin_hypercube.members} members, seed ${design.latin_hypercube.seed}.`;
  if ("saltelli" in design)
    return `Design: ${design.saltelli.base_members} rows after Saltelli, seed ${design.saltelli.seed}.`;
  if ("morris" in design)
    return `Design: ${design.morris.trajectories} Morris trajectories on ${design.morris.levels} levels, seed ${design.morris.seed}.`;
  if ("full_factorial" in design) return "Design: all combinations of levels.";
  if ("one_at_a_time" in design) return "Design: one input after the other away from the median.";
  return `Design: ${design.explicit.members.length} members with given values.`;
}
