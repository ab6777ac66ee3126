import { useEffect, useMemo, useState } from "preact/hooks";
import { figure } from "../parts/format";
import { ProblemNotice } from "../parts/problem-notice";
import type { ListedMember, StudyState } from "./documents";
import { MOST_MEMBERS, MemberPages } from "./member-pages";
import { type Column, type Order, columns, sorted } from "./members";
import { useLive } from "./use-live";

/** Rows of a page of the table. */
const ROWS = 50;

interface TableProps {
  state: StudyState;
  /** Members on the coarsest level. */
  coarsest: ListedMember[];
  /** Cell sizes of the levels [m]; none of a study on one level. */
  cellSizes: number[];
}

/** Members of a study, on the level that is chosen. */
export function MembersTable({ state, coarsest, cellSizes }: TableProps) {
  const [level, setLevel] = useState(0);
  return (
    <section aria-labelledby="members-title">
      <h2 id="members-title">Members</h2>
      {cellSizes.length > 1 && (
        <label>
          Level of cells{" "}
          <select value={level} onChange={(event) => setLevel(Number(event.currentTarget.value))}>
            {cellSizes.map((size, level) => (
              <option key={size} value={level}>
                {level}: cells of {figure(size)} m
              </option>
            ))}
          </select>
        </label>
      )}
      {level === 0 ? <Rows state={state} members={coarsest} /> : <FinerRows key={level} state={state} level={level} />}
    </section>
  );
}

function FinerRows({ state, level }: { state: StudyState; level: number }) {
  const read = useMemo(() => {
    const pages = new MemberPages(state.id, level);
    return (signal: AbortSignal) => pages.read(signal);
  }, [state.id, level]);
  const { value, problem } = useLive(read, () => state.status === "running", [read, state.status]);
  if (problem) return <ProblemNotice problem={problem} />;
  return value ? <Rows state={state} members={value} /> : <p class="quiet">Reading …</p>;
}

function Rows({ state, members }: { state: StudyState; members: ListedMember[] }) {
  const shown = useMemo(() => columns(state.study), [state]);
  const [order, setOrder] = useState<Order>({ column: "member", isDescending: false });
  const [page, setPage] = useState(0);
  const rows = useMemo(() => {
    const column = shown.find(({ key }) => key === order.column) ?? shown[0];
    return column ? sorted(members, column, order.isDescending) : members;
  }, [members, shown, order]);
  const pages = Math.max(1, Math.ceil(rows.length / ROWS));
  useEffect(() => setPage(0), [order]);
  const first = Math.min(page, pages - 1) * ROWS;
  if (members.length === 0) return <p>No member has been made yet.</p>;
  return (
    <>
      {members.length >= MOST_MEMBERS && <p>The first {MOST_MEMBERS} members; the files have all.</p>}
      <div class="scroll" tabIndex={0} role="region" aria-label="Members of the study">
        <table class="members">
          <Head columns={shown} order={order} onOrder={setOrder} />
          <tbody>
            {rows.slice(first, first + ROWS).map((member) => (
              <MemberRow key={member.member} member={member} columns={shown} />
            ))}
          </tbody>
        </table>
      </div>
      <nav class="actions" aria-label="Pages of members">
        <button type="button" disabled={first === 0} onClick={() => setPage(first / ROWS - 1)}>
          Previous
        </button>
        <span aria-live="polite">
          {first + 1} to {Math.min(first + ROWS, rows.length)} of {rows.length}
        </span>
        <button type="button" disabled={first + ROWS >= rows.length} onClick={() => setPage(first / ROWS + 1)}>
          Next
        </button>
      </nav>
    </>
  );
}

function Head({ columns, order, onOrder }: { columns: Column[]; order: Order; onOrder: (order: Order) => void }) {
  return (
    <thead>
      <tr>
        {columns.map(({ key, title, isNumber }) => {
          const isHere = order.column === key;
          return (
            <th
              key={key}
              scope="col"
              class={isNumber ? "number" : ""}
              aria-sort={!isHere ? "none" : order.isDescending ? "descending" : "ascending"}
            >
              <button
                type="button"
                class="sort"
                onClick={() => onOrder({ column: key, isDescending: isHere && !order.isDescending })}
              >
                {title}
                <span aria-hidden="true">{!isHere ? "" : order.isDescending ? " ▼" : " ▲"}</span>
              </button>
            </th>
          );
        })}
      </tr>
    </thead>
  );
}

function MemberRow({ member, columns }: { member: ListedMember; columns: Column[] }) {
  return (
    <tr>
      {columns.map((column) => {
        const value = column.of(member);
        if (column.key === "member")
          return (
            <th key="member" scope="row" class="number">
              {member.job ? <a href={`#/jobs/${member.job}`}>{value}</a> : value}
            </th>
          );
        if (column.key === "status")
          return (
            <td key="status">
              <span class={`status ${member.status ?? ""}`}>{member.status ?? "no job"}</span>
              {value !== member.status && member.status !== null && ` ${value}`}
            </td>
          );
        return (
          <td key={column.key} class="number">
            {typeof value === "number" ? figure(value, 4) : (value ?? "–")}
          </td>
        );
      })}
    </tr>
  );
}
