import { useEffect, useRef, useState } from "preact/hooks";
import { Link, useLocation } from "wouter-preact";
import { request } from "../api/client";
import { isPassing } from "../api/problem";
import { ProblemNotice } from "../parts/problem-notice";
import { selectValue } from "../parts/text-area";
import { uniqueKey } from "../parts/unique-key";
import type { StudyState } from "./documents";
import { PlanNotice } from "./plan-notice";
import { PRESETS } from "./presets";
import { useStudyPlan } from "./use-study-plan";

/** Form for a new study: its document, checked and planned while it is written. */
export function NewStudy() {
  const [text, setText] = useState(() => JSON.stringify(PRESETS[0], null, 2));
  const editor = useRef<HTMLTextAreaElement>(null);
  const checked = useStudyPlan(text);
  return (
    <div class="study">
      <h1>New study</h1>
      <p>
        A study computes one scenario many times with uncertain inputs, and answers with probabilities. Begin with one
        of these, and change what you like: an input is a place in the scenario, by its JSON pointer.{" "}
        <Link href="/studies">All studies</Link>
      </p>
      <Presets onChoose={(preset) => setText(JSON.stringify(preset, null, 2))} />
      <div class="columns">
        <div>
          <label for="study-text">The study, as JSON</label>
          <textarea
            id="study-text"
            ref={editor}
            class="code wide"
            rows={28}
            spellcheck={false}
            value={text}
            aria-invalid={checked.fault !== undefined || checked.problem !== undefined}
            aria-describedby="study-plan"
            onInput={(event) => setText(event.currentTarget.value)}
          />
        </div>
        <div id="study-plan">
          <PlanNotice
            checked={checked}
            onPointer={(pointer) => editor.current && selectValue(editor.current, pointer)}
          />
          <Submit text={text} isAllowed={checked.plan !== undefined && !checked.isChecking} />
        </div>
      </div>
    </div>
  );
}

function Presets({ onChoose }: { onChoose: (preset: { title: string }) => void }) {
  return (
    <label>
      Begin with{" "}
      <select onChange={(event) => onChoose(PRESETS[event.currentTarget.selectedIndex] ?? { title: "" })}>
        {PRESETS.map(({ title }) => (
          <option key={title}>{title}</option>
        ))}
      </select>
    </label>
  );
}

function Submit({ text, isAllowed }: { text: string; isAllowed: boolean }) {
  const [, navigate] = useLocation();
  const [problem, setProblem] = useState<unknown>();
  const [isSending, setIsSending] = useState(false);
  // One key for one text: a second press after a lost answer finds the first study.
  const key = useRef(uniqueKey());
  useEffect(() => {
    key.current = uniqueKey();
    setProblem(undefined);
  }, [text]);
  const submit = async () => {
    setIsSending(true);
    setProblem(undefined);
    try {
      const headers = { "Content-Type": "application/json", "Idempotency-Key": key.current };
      const answer = await request("v1/studies", { method: "POST", headers, body: text });
      navigate(`/studies/${((await answer.json()) as StudyState).id}`);
    } catch (error) {
      if (!isPassing(error)) key.current = uniqueKey();
      setProblem(error);
      setIsSending(false);
    }
  };
  return (
    <>
      <div class="actions">
        <button type="button" class="primary" disabled={!isAllowed || isSending} onClick={() => void submit()}>
          Submit the study
        </button>
      </div>
      {problem !== undefined && <ProblemNotice problem={problem} />}
    </>
  );
}
