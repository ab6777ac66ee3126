import type { JobStatus } from "../api/client";
import { ALL, type Filter, STATUSES } from "./filter";

/** Last day that can be typed: years have four digits in the interface. */
const LAST_DAY = "9999-12-31";

/** Form of the filter of the list. */
export function FilterForm({ filter, change }: { filter: Filter; change: (filter: Filter) => void }) {
  const toggle = (status: JobStatus, isWanted: boolean) => {
    const others = filter.statuses.filter((other) => other !== status);
    change({ ...filter, statuses: isWanted ? [...others, status] : others });
  };
  const text = (key: "label" | "from" | "to") => (event: { currentTarget: HTMLInputElement }) =>
    change({ ...filter, [key]: event.currentTarget.value });
  return (
    <form class="filter" role="search" aria-label="Jobs" onSubmit={(event) => event.preventDefault()}>
      <fieldset class="statuses">
        <legend>State</legend>
        {STATUSES.map((status) => (
          <label key={status}>
            <input
              type="checkbox"
              checked={filter.statuses.includes(status)}
              onChange={(event) => toggle(status, event.currentTarget.checked)}
            />{" "}
            {status}
          </label>
        ))}
      </fieldset>
      <label>
        Label
        <input value={filter.label} onChange={text("label")} />
      </label>
      <label>
        Accepted from
        <input type="date" max={LAST_DAY} value={filter.from} onChange={text("from")} />
      </label>
      <label>
        to
        <input type="date" max={LAST_DAY} value={filter.to} onChange={text("to")} />
      </label>
      <label class="members">
        <input
          type="checkbox"
          checked={filter.members}
          onChange={(event) => change({ ...filter, members: event.currentTarget.checked })}
        />{" "}
        Members of studies
      </label>
      <button type="button" onClick={() => change(ALL)}>
        Show all
      </button>
    </form>
  );
}
