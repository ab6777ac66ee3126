import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { type JsonObject, same } from "../parts/json-document";
import type { Schemas } from "../scenario/schema";
import { type Draft, keepDraft } from "./draft";
import { FormContext } from "./form-context";
import { JsonEditor } from "./json-editor";
import { DifferenceList, ViolationList } from "./lists";
import { PlanPanel } from "./plan-panel";
import { SceneFigure } from "./scene-figure";
import { Sections } from "./sections";
import { SubmitForm } from "./submit-form";
import { ToRun } from "./to-run";
import { Toolbar } from "./toolbar";
import { useFormState } from "./use-form-state";
import { type PlanState, usePlan } from "./use-plan";
import { useWriting } from "./use-writing";

interface EditorProps {
  /** Address of the form, whose draft this is. */
  address: string;
  begin: Draft;
  schemas: Schemas;
  preset: string | undefined;
}

/** Fields or text of a scenario, its drawings, and its plan. */
export function Editor({ address, begin, schemas, preset }: EditorProps) {
  const writing = useWriting(begin);
  const { history, document, origin, text, replace } = writing;
  const [goTo, setGoTo] = useState<{ pointer: string }>();
  const plan = usePlan(document);
  const state = useFormState({
    schemas,
    document,
    original: origin.original,
    violations: plan.violations,
    replace,
    revealElsewhere: (pointer) => {
      if (text.isShown) setGoTo({ pointer });
      return text.isShown;
    },
  });
  const forget = useDraft(address, document, origin);
  const dropping = useDrop((file) => void writing.readFile(file));
  const isBroken = text.isShown && text.broken !== undefined;
  return (
    <FormContext.Provider value={state}>
      <div class={dropping.isOver ? "scenario-form dropping" : "scenario-form"} {...dropping.handlers}>
        <p class="lead">
          Describe a channel or a terrain, a flow that is released on it, and the bodies in its way. The drawing and the
          expected time follow what you enter; then run it.
        </p>
        <Toolbar
          preset={preset}
          isText={text.isShown}
          setIsText={text.show}
          undo={history.past.length > 0 ? writing.undo : undefined}
          redo={history.future.length > 0 ? writing.redo : undefined}
          startOver={isBroken || !same(document, origin.original) ? writing.startOver : undefined}
          readFile={(file) => void writing.readFile(file)}
        />
        <ToRun planned={plan.planned} />
        <div class="edit">
          <ViolationList />
          <DifferenceList from={origin.from} />
          {text.isShown ? (
            <JsonEditor
              key={text.opened}
              document={document}
              onDocument={(next) => replace(next, "text")}
              broken={text.broken}
              onBroken={text.setBroken}
              goTo={goTo}
            />
          ) : (
            <Sections />
          )}
        </div>
        <Beside plan={plan} isBroken={isBroken} onSubmitted={forget} />
      </div>
    </FormContext.Provider>
  );
}

/** Drawings of the scene, the plan, and the button that runs it. */
function Beside({ plan, isBroken, onSubmitted }: { plan: PlanState; isBroken: boolean; onSubmitted: () => void }) {
  return (
    <div class="beside">
      <SceneFigure />
      <div class="card outlook">
        <SubmitForm
          obstacle={obstacleOf(plan.violations.length, isBroken)}
          isBlocked={isBroken}
          onSubmitted={onSubmitted}
        />
        <PlanPanel plan={plan} />
      </div>
    </div>
  );
}

function obstacleOf(violations: number, isBroken: boolean): string | undefined {
  if (isBroken) return "The text is no JSON yet. The plan is that of its last correct state.";
  return violations > 0 ? "It will be refused until no rule is broken." : undefined;
}

/** Keeps the draft while it is changed; returns the means to forget it. */
function useDraft(
  address: string,
  document: JsonObject,
  { original, from, isOfFile }: Omit<Draft, "document">,
): () => void {
  const isForgotten = useRef(false);
  // Before the page can be left.
  useLayoutEffect(() => {
    const isNew = isOfFile || !same(document, original);
    if (!isForgotten.current) keepDraft(address, isNew ? { document, original, from, isOfFile } : undefined);
  }, [address, document, original]);
  return () => {
    isForgotten.current = true;
    keepDraft(address, undefined);
  };
}

/** Drop of a file on an element. */
function useDrop(onFile: (file: File) => void) {
  const [isOver, setIsOver] = useState(false);
  const handlers = {
    onDragOver: (event: DragEvent) => {
      if (!event.dataTransfer?.types.includes("Files")) return;
      event.preventDefault();
      setIsOver(true);
    },
    onDragLeave: (event: DragEvent) => {
      if (event.target === event.currentTarget) setIsOver(false);
    },
    onDrop: (event: DragEvent) => {
      setIsOver(false);
      const [file] = event.dataTransfer?.files ?? [];
      if (!file) return;
      event.preventDefault();
      onFile(file);
    },
  };
  return { isOver, handlers };
}
