import { figure } from "../parts/format";
import type { StudyAnswers } from "./documents";
import { unitOfKey } from "../parts/words";
import { nameOf, ofBody, titled } from "./names";
import { percent } from "./percent";
import { MeanAnswer } from "./value-answers";
import type { Schemas } from "../api/client";

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
export function LevelsTable({
  answers,
  accuracy,
}: {
  answers: StudyAnswers;
  accuracy: Schemas["StudyAccuracy"] | null | undefined;
}) {
  const levels = answers.levels ?? [];
  const reached = answers.accuracy;
  if (levels.length === 0 && !reached) return null;
  const unit = unitOfKey(accuracy?.quantity ?? "");
  const has = (reached?.levels.length ?? 0) > 0;
  return (
    <section aria-labelledby="levels-title">
      <h2 id="levels-title">Levels of cells</h2>
      {levels.length > 0 && (
        <div class="scroll" tabIndex={0} role="region" aria-label="Levels of cells">
          <table>
            <thead>
              <tr>
                <th scope="col" class="number">
                  Cell size [m]
                </th>
                <th scope="col" class="number">
                  Members
                </th>
                <th scope="col" class="number">
                  Finished
                </th>
                <th scope="col" class="number">
                  Point-steps of a member
                </th>
                {has && (
                  <th scope="col" class="number">
                    {titled(`Mean, ${nameOf(accuracy?.quantity ?? "")}`, unit)}
                  </th>
                )}
                {has && (
                  <th scope="col" class="number">
                    {titled("Adds ±", unit)}
                  </th>
                )}
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
                  {has && <td class="number">{figure(reached?.levels[place]?.mean, 4)}</td>}
                  {has && <td class="number">{figure(reached?.levels[place]?.standard_deviation, 3)}</td>}
                </tr>
              ))}
            </tbody>
          </table>
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
