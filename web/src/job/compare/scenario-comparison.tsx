import { useState } from "preact/hooks";
import type { Scenario } from "../../api/client";
import { differencesOf } from "./differences";

/** Rows shown before "Show all". */
const ROWS_AT_FIRST = 20;

/** Fields in which two scenarios differ. */
export function ScenarioComparison({ first, second }: { first: Scenario; second: Scenario }) {
  const [isWhole, setIsWhole] = useState(false);
  const differences = differencesOf(first, second);
  const rows = isWhole ? differences : differences.slice(0, ROWS_AT_FIRST);
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
              {rows.map(({ pointer, first, second }) => (
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
      {differences.length > ROWS_AT_FIRST && (
        <button type="button" aria-expanded={isWhole} onClick={() => setIsWhole(!isWhole)}>
          {isWhole ? `Show the first ${ROWS_AT_FIRST} differences` : `Show all ${differences.length} differences`}
        </button>
      )}
    </section>
  );
}

/** Longest value that stands in its cell as a whole. */
const LONGEST = 80;

function shown(value: unknown) {
  if (value === undefined) return <span class="quiet">not there</span>;
  const text = JSON.stringify(value);
  if (text.length <= LONGEST) return <code>{text}</code>;
  return (
    <details>
      <summary>{Array.isArray(value) ? `${value.length} entries` : summaryOf(value)}</summary>
      <pre>{JSON.stringify(value, null, 2)}</pre>
    </details>
  );
}

/** What a long value is: of a body its shape. */
function summaryOf(value: unknown): string {
  if (typeof value !== "object" || value === null) return `${String(value).slice(0, LONGEST)} …`;
  const [kind] = Object.keys((value as { shape?: object }).shape ?? {});
  return kind ? `a body: ${kind}` : `${Object.keys(value).length} fields`;
}
