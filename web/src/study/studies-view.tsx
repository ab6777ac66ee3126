import { useMemo, useState } from "preact/hooks";
import { Link } from "wouter-preact";
import type { Schemas } from "../api/client";
import { moment } from "../parts/format";
import { ProblemNotice } from "../parts/problem-notice";
import { useTitle } from "../parts/use-title";
import type { StudySummary } from "./documents";
import { TaggedAnswer } from "./tagged";
import { useLive } from "./use-live";
import "./study.css";

type Page = Schemas["StudyPage"];

const STATES = ["running", "successful", "failed", "dismissed"] as const;

/** View of all studies, newest first, a page at a time. */
export function StudiesView() {
  useTitle("Studies");
  const [status, setStatus] = useState("");
  /** Cursors of the pages up to the one that is shown. */
  const [cursors, setCursors] = useState<string[]>([]);
  const cursor = cursors.at(-1);
  const read = useMemo(() => {
    const query = new URLSearchParams({ limit: "20", ...(status && { status }), ...(cursor && { cursor }) });
    const page = new TaggedAnswer<Page>(`v1/studies?${query}`);
    return (signal: AbortSignal) => page.read(signal);
  }, [status, cursor]);
  const { value: page, problem } = useLive(read, () => true, [read]);
  const choose = (status: string) => {
    setStatus(status);
    setCursors([]);
  };
  return (
    <div class="study">
      <h1>Studies</h1>
      <p>
        Where does it end up, how probably, and what does that depend on? A study computes one scenario many times with
        uncertain inputs.
      </p>
      <div class="actions">
        <Link href="/studies/new" class="button primary">
          New study
        </Link>
        <label>
          State{" "}
          <select value={status} onChange={(event) => choose(event.currentTarget.value)}>
            <option value="">all</option>
            {STATES.map((state) => (
              <option key={state}>{state}</option>
            ))}
          </select>
        </label>
      </div>
      {problem !== undefined && <ProblemNotice problem={problem} />}
      {!page && problem === undefined && <p class="quiet">Reading …</p>}
      {page && <StudyList page={page} isFirst={cursors.length === 0} isFiltered={status !== ""} />}
      {page && (cursors.length > 0 || page.next_cursor) && (
        <nav class="actions" aria-label="Pages of studies">
          <button type="button" disabled={cursors.length === 0} onClick={() => setCursors(cursors.slice(0, -1))}>
            Newer
          </button>
          <button
            type="button"
            disabled={!page.next_cursor}
            onClick={() => page.next_cursor && setCursors([...cursors, page.next_cursor])}
          >
            Older
          </button>
        </nav>
      )}
    </div>
  );
}

function StudyList({ page: { studies }, isFirst, isFiltered }: { page: Page; isFirst: boolean; isFiltered: boolean }) {
  if (studies.length === 0)
    return (
      <p class="quiet">
        {isFiltered || !isFirst ? "No study is in this state." : "There are no studies yet. Begin with a new one."}
      </p>
    );
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label="Studies, newest first">
      <table>
        <thead>
          <tr>
            <th scope="col">Study</th>
            <th scope="col">State</th>
            <th scope="col" class="number">
              Members ended
            </th>
            <th scope="col">Submitted</th>
          </tr>
        </thead>
        <tbody>
          {studies.map((study) => (
            <StudyRow key={study.id} study={study} />
          ))}
        </tbody>
      </table>
    </div>
  );
}

function StudyRow({ study: { id, title, status, members, members_ended, created } }: { study: StudySummary }) {
  return (
    <tr>
      <th scope="row" class="title">
        <Link href={`/studies/${id}`}>{title || "Untitled study"}</Link>
      </th>
      <td>
        <span class={`status ${status}`}>{status}</span>
      </td>
      <td class="number">
        {members_ended} of {members}
      </td>
      <td>
        <time dateTime={created}>{moment(created)}</time>
      </td>
    </tr>
  );
}
