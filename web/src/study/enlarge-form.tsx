import { useState } from "preact/hooks";
import { request } from "../api/client";
import { ProblemNotice } from "../parts/problem-notice";
import type { StudyState } from "./documents";
import { type Growth, growthOf } from "./enlargement";

/** Form that enlarges a study, or changes its questions, levels or stopping rule. */
export function EnlargeForm({ state, again }: { state: StudyState; again: () => void }) {
  const growth = growthOf(state.study.design);
  const [problem, setProblem] = useState<unknown>();
  const [isSent, setIsSent] = useState(false);
  if (state.status === "failed" || state.status === "dismissed") return null;
  const send = async (body: string) => {
    setProblem(undefined);
    setIsSent(false);
    try {
      const headers = { "Content-Type": "application/json" };
      await request(`v1/studies/${state.id}`, { method: "PATCH", headers, body });
      setIsSent(true);
      again();
    } catch (error) {
      setProblem(error);
    }
  };
  return (
    <details class="enlarge">
      <summary>Enlarge or change this study</summary>
      <p>No run is lost: the larger design begins with the members that are there.</p>
      {growth && <SizeForm key={growth.now} growth={growth} send={(body) => void send(body)} />}
      <ChangesForm state={state} send={(body) => void send(body)} />
      {problem !== undefined && <ProblemNotice problem={problem} />}
      {isSent && <p role="status">The study was changed.</p>}
    </details>
  );
}

/** Form of the number by which a design grows; begun anew once it has grown. */
function SizeForm({ growth, send }: { growth: Growth; send: (body: string) => void }) {
  const [size, setSize] = useState(growth.next);
  return (
    <form
      class="actions"
      onSubmit={(event) => {
        event.preventDefault();
        send(JSON.stringify({ design: growth.to(size) }));
      }}
    >
      <label>
        {growth.name}, now {growth.now}{" "}
        <input
          type="number"
          min={growth.now + 1}
          required
          value={size}
          onInput={(event) => setSize(Number(event.currentTarget.value))}
        />
      </label>
      <button type="submit" class="primary">
        Enlarge
      </button>
    </form>
  );
}

/** Form of any change, as JSON. */
function ChangesForm({ state, send }: { state: StudyState; send: (body: string) => void }) {
  const [changes, setChanges] = useState<string>();
  return (
    <form
      onSubmit={(event) => {
        event.preventDefault();
        send(changes ?? questionsOf(state));
      }}
    >
      <label>
        Other changes, as JSON: <code>design</code>, <code>questions</code>, <code>finer_levels</code>,{" "}
        <code>stop</code>, <code>accuracy</code>
        <textarea
          class="code wide"
          rows={8}
          spellcheck={false}
          value={changes ?? questionsOf(state)}
          onInput={(event) => setChanges(event.currentTarget.value)}
        />
      </label>
      <div class="actions">
        <button type="submit">Change the study</button>
      </div>
    </form>
  );
}

function questionsOf({ study }: StudyState): string {
  return JSON.stringify({ questions: study.questions ?? [] }, null, 2);
}
