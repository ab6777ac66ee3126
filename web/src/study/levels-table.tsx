import { figure } from "../parts/format";
import { unitOfKey } from "../parts/words";
import type { Schemas } from "../api/client";
import type { StudyAnswers } from "./documents";
import { nameOf, ofBody, titled } from "./names";
import { percent } from "./percent";
import { MeanAnswer } from "./value-answers";

const NEEDED: Record<Schemas["Needed"], string> = {
  nothing: "The target is met.",
  members: "More members are needed.",
  finer_level: "A level of finer cells is needed.",
  smaller_cells: "Smaller cells are needed than may be taken.",
  budget: "More work is needed than the budget allows.",
  larger_design: "A larger design is needed than may be taken.",
  successes: "More members that come to their end are needed.",
};

/** Levels of cells of a multilevel study, and the accuracy it has reached. */
export function LevelsTable({ answers, accuracy }: LevelsProps) {
  const levels = answers.levels ?? [];
  const reached = answers.accuracy;
  if (levels.length === 0 && !reached) return null;
  return (
    <section aria-labelledby="levels-title">
      <h2 id="levels-title">Levels of cells</h2>
      {levels.length > 0 && (
        <div class="scroll" tabIndex={0} role="region" aria-label="Levels of cells">
          <Levels answers={answers} accuracy={accuracy} />
        </div>
      )}
      {reached && accuracy && (
        <>
          <h3>Accuracy of the mean: {ofBody(accuracy.quantity, accuracy.body)}</h3>
          <MeanAnswer quantity={accuracy.quantity} answer={reached.mean} />
          <p>
            Reached ±{percent(reached.reached)} of ±{percent(reached.target)} asked for. {NEEDED[reached.needed]}{" "}
            {figure(reached.point_steps)} point-steps so far
            {reached.gain
              ? `; ${reached.one_level_members} members of the finest cells alone would take ${figure(reached.gain, 2)} times as many`
              : ""}
            .
          </p>
        </>
      )}
    </section>
  );
}

interface LevelsProps {
  answers: StudyAnswers;
  accuracy: Schemas["StudyAccuracy"] | null | undefined;
}

function Levels({ answers: { levels = [], accuracy: reached }, accuracy }: LevelsProps) {
  const quantity = accuracy?.quantity ?? "";
  const means = reached?.levels ?? [];
  const titles = ["Cell size [m]", "Members", "Finished", "Point-steps of a member"];
  if (means.length > 0) {
    const unit = unitOfKey(quantity);
    titles.push(titled(`Mean, ${nameOf(quantity)}`, unit), titled("Adds ±", unit));
  }
  return (
    <table>
      <thead>
        <tr>
          {titles.map((title) => (
            <th key={title} scope="col" class="number">
              {title}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {levels.map((level, place) => (
          <tr key={level.cell_size_m}>
            <th scope="row" class="number">
              {figure(level.cell_size_m)}
            </th>
            <td class="number">{level.members}</td>
            <td class="number">{level.finished}</td>
            <td class="number">{figure(level.point_steps_per_member)}</td>
            {means.length > 0 && <td class="number">{figure(means[place]?.mean, 4)}</td>}
            {means.length > 0 && <td class="number">{figure(means[place]?.standard_deviation, 3)}</td>}
          </tr>
        ))}
      </tbody>
    </table>
  );
}
