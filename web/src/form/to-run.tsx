import type { Planned } from "../api/client";
import { duration } from "../parts/format";

/** Way to "Run it" where that stands below all fields: on narrow windows. */
export function ToRun({ planned }: { planned: Planned | undefined }) {
  const time = planned?.wall_time.expected_s;
  return (
    <p class="to-run">
      <button type="button" onClick={goToRun}>
        Go to the run
      </button>
      {typeof time === "number" && <span class="quiet">about {duration(time)} of computing</span>}
    </p>
  );
}

function goToRun(): void {
  const button = document.querySelector<HTMLButtonElement>("form.submit button[type=submit]");
  button?.focus({ preventScroll: true });
  button?.scrollIntoView({ block: "center" });
}
