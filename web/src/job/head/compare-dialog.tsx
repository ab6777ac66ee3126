import { useLocation } from "wouter-preact";
import { api, data } from "../../api/client";
import { moment } from "../../parts/format";
import { ProblemNotice } from "../../parts/problem-notice";
import { useAnswer } from "../../parts/use-answer";
import { Modal } from "./modal";

/** Choice of another successful job, to compare one with. */
export function CompareDialog({ id, close }: { id: string; close: () => void }) {
  const [, goTo] = useLocation();
  const { value, problem } = useAnswer(
    (signal) => data(api.GET("/v1/jobs", { params: { query: { status: ["successful"], limit: 100 } }, signal })),
    [],
  );
  const others = value?.jobs.filter((job) => job.id !== id);
  const submit = (event: SubmitEvent) => {
    event.preventDefault();
    const other = new FormData(event.target as HTMLFormElement).get("other");
    close();
    goTo(`/compare/${id}/${String(other)}`);
  };
  return (
    <Modal title="Compare with another job" close={close}>
      <form onSubmit={submit}>
        {problem ? <ProblemNotice problem={problem} /> : null}
        {others?.length === 0 && <p>There is no other successful job.</p>}
        {others && others.length > 0 && (
          <label>
            Successful job, the latest first
            <select name="other" class="wide">
              {others.map((job) => (
                <option key={job.id} value={job.id}>
                  {job.title || "Untitled"}, {moment(job.created)}, {job.id.slice(-6)}
                </option>
              ))}
            </select>
          </label>
        )}
        <div class="actions">
          <button type="submit" class="primary" disabled={!others?.length}>
            Compare
          </button>
          <button type="button" onClick={close}>
            Cancel
          </button>
        </div>
      </form>
    </Modal>
  );
}
