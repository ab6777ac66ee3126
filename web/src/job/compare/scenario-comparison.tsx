import type { Scenario } from "../../api/client";
import { differencesOf } from "./differences";

/** Fields in which two scenarios differ. */
export function ScenarioComparison({ first, second }: { first: Scenario; second: Scenario }) {
  const differences = differencesOf(first, second);
  return (
    <section aria-labelledby="scenarios">
      <h2 id="scenarios">Scenarios</h2>
      {differences.length === 0 ? (
        <p>The scenarios are equal in every field.</p>
      ) : (
        <div class="scroll" tabIndex={0} role="region" aria-label="Differing fields">
          <table class="fields">
            <thead>
              <tr>
                <th>Field</th>
                <th>First</th>
                <th>Second</th>
              </tr>
            </thead>
            <tbody>
              {differences.map(({ pointer, first, second }) => (
                <tr key={pointer}>
                  <th scope="row">
                    <code>{pointer}</code>
                  </th>
                  <td>{shown(first)}</td>
                  <td>{shown(second)}</td>
                </tr>
              ))}
            </tbody>
          </table>
        </div>
      )}
    </section>
  );
}

function shown(value: unknown) {
  return value === undefined ? <span class="quiet">not there</span> : <code>{JSON.stringify(value)}</code>;
}
