import { useRef, useState } from "preact/hooks";
import { useLocation } from "wouter-preact";
import { ServiceProblem, isPassing } from "../api/problem";
import { ProblemNotice } from "../parts/problem-notice";
import { type Attempt, attemptFor } from "./attempt";
import { useForm } from "./form-context";
import { submit } from "./submission";

/** Characters of a label. */
const LABEL = "[A-Za-z0-9._:=\\/\\-]{1,64}";

interface SubmitFormProps {
  /** Why the scenario can't be run as it is; undefined if it can. */
  obstacle: string | undefined;
  /** True if what would run is not what is shown. */
  isBlocked: boolean;
  onSubmitted: () => void;
}

/** Button that runs the scenario, with an optional label. */
export function SubmitForm({ obstacle, isBlocked, onSubmitted }: SubmitFormProps) {
  const { document } = useForm();
  const [, navigate] = useLocation();
  const [label, setLabel] = useState("");
  const [problem, setProblem] = useState<unknown>();
  const [isSending, setIsSending] = useState(false);
  const attempt = useRef<Attempt>();
  const send = async (event: SubmitEvent) => {
    event.preventDefault();
    setIsSending(true);
    setProblem(undefined);
    attempt.current = attemptFor(document, label.trim(), attempt.current);
    try {
      const { id } = await submit(attempt.current);
      onSubmitted();
      navigate(`/jobs/${id}`);
    } catch (problem) {
      if (!isPassing(problem)) attempt.current = undefined;
      setProblem(problem);
      setIsSending(false);
    }
  };
  return (
    <form class="submit" onSubmit={(event) => void send(event)}>
      <div class="actions">
        <button type="submit" class="primary" disabled={isSending || isBlocked} aria-describedby="obstacle">
          {isSending ? "Submitting …" : "Run it"}
        </button>
        <label>
          <span>Label</span>
          <input
            type="text"
            value={label}
            pattern={LABEL}
            maxLength={64}
            title="Letters, digits and . _ : = / -"
            placeholder="optional"
            autocomplete="off"
            onInput={({ currentTarget }) => setLabel(currentTarget.value)}
          />
        </label>
      </div>
      <p class="help" id="obstacle">
        {obstacle ?? "The job is stored and queued. Its page shows the progress and then the answer."}
      </p>
      {problem !== undefined && <Refused problem={problem} />}
    </form>
  );
}

function Refused({ problem }: { problem: unknown }) {
  const seconds = problem instanceof ServiceProblem ? problem.retryAfterS : undefined;
  return (
    <>
      <ProblemNotice problem={problem} />
      {isPassing(problem) && (
        <p class="help">
          {seconds !== undefined ? `Try again in ${seconds} s.` : "Try again."} The job is made once, even if the first
          attempt did arrive.
        </p>
      )}
    </>
  );
}
