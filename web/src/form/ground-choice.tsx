import { type Ground, groundOf } from "../scenario/ground";
import { useForm } from "./form-context";
import { hasOther, otherThan, withoutOther } from "./ground";
import { labelOf } from "./words";

const GROUNDS: Ground[] = ["channel", "terrain"];

/** Choice of the ground. */
export function GroundChoice() {
  const { schemas, document, replace, chooseGround } = useForm();
  const ground = groundOf(document);
  return (
    <div class="ground-choice">
      <span aria-hidden="true">Ground</span>
      <div class="choice" role="group" aria-label="Ground">
        {GROUNDS.map((one) => (
          <button key={one} type="button" aria-pressed={ground === one} onClick={() => chooseGround(one)}>
            {labelOf(one)}
          </button>
        ))}
      </div>
      {hasOther(document, ground) && (
        <p class="notice warning">
          The scenario also has fields of a {otherThan(ground)}, which are not shown here.{" "}
          <button type="button" class="link" onClick={() => replace(withoutOther(document, ground, schemas), "")}>
            Remove them
          </button>
        </p>
      )}
    </div>
  );
}
