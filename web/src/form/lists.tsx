import { schemaAt, unitOf } from "../scenario/schema";
import { useForm } from "./form-context";
import { FieldLink } from "./plan-panel";
import { valueText } from "./words";

/** Most violations and differences that are listed at once. */
const SHOWN = 8;

/** Violations with links to their fields. */
export function ViolationList() {
  const { violations } = useForm();
  const count = violations.length;
  return (
    <div role="status">
      {count > 0 && (
        <div class="notice problem">
          <strong>{count === 1 ? "1 rule is broken" : `${count} rules are broken`}</strong>
          <ul class="links">
            {violations.slice(0, SHOWN).map(({ pointer, detail }) => (
              <li key={`${pointer} ${detail}`}>
                {pointer != null && <FieldLink pointer={pointer} />} {detail}
              </li>
            ))}
          </ul>
          {count > SHOWN && <p>And {count - SHOWN} more, at their fields.</p>}
        </div>
      )}
    </div>
  );
}

/** Fields that differ from the original, with links to them. */
export function DifferenceList({ from }: { from: string }) {
  const { differences, document, schemas } = useForm();
  const count = differences.length;
  if (count === 0) return null;
  return (
    <details class="differences">
      <summary>
        {count === 1 ? "1 field differs" : `${count} fields differ`} from {from}
      </summary>
      <ul class="links">
        {differences.slice(0, 5 * SHOWN).map(({ pointer, was, is }) => {
          const schema = schemaAt(pointer, document, schemas);
          const unit = schema && unitOf(schema);
          return (
            <li key={pointer}>
              <FieldLink pointer={pointer} /> {valueText(was, unit)} → {valueText(is, unit)}
            </li>
          );
        })}
      </ul>
    </details>
  );
}
