import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { type JsonObject, isObject, same } from "../parts/json-document";
import { type Draft, keepDraft } from "./draft";
import { FormContext } from "./form-context";
import { begin as beginHistory, edited, redone, undone } from "./history";
import { JsonEditor } from "./json-editor";
import { readText } from "../parts/json-text";
import { DifferenceList, ViolationList } from "./lists";
import { PlanPanel } from "./plan-panel";
import { SceneFigure } from "./scene-figure";
import type { Schemas } from "./schema";
import { Sections } from "./sections";
import { SubmitForm } from "./submit-form";
import { ToRun } from "./to-run";
import { Toolbar } from "./toolbar";
import { useFormState } from "./use-form-state";
import { usePlan } from "./use-plan";

interface EditorProps {
  /** Address of the form, whose draft this is. */
  address: string;
  begin: Draft;
  schemas: Schemas;
  preset: string | undefined;
}

/** Fields or text of a scenario, its drawings, and its plan. */
export function Editor({ address, begin, schemas, preset }: EditorProps) {
  const [history, setHistory] = useState(() => beginHistory(begin.document));
  const [origin, setOrigin] = useState<Omit<Draft, "document">>(begin);
  const { original, from } = origin;
  const [isText, setIsText] = useState(false);
  const [broken, setBroken] = useState<string>();
  /** Counts texts that come from elsewhere than the editor of the text, which begins anew with each. */
  const [opened, setOpened] = useState(0);
  const [goTo, setGoTo] = useState<{ pointer: string }>();
  const document = history.present;
  const plan = usePlan(document);
  const replace = (document: JsonObject, edit: string) =>
    setHistory((history) => edited(history, document, edit, Date.now()));
  const state = useFormState({
    schemas,
    document,
    original,
    violations: plan.violations,
    replace,
    revealElsewhere: (pointer) => {
      if (isText) setGoTo({ pointer });
      return isText;
    },
  });
  const forget = useDraft(address, document, origin);
  const open = (text: string | undefined) => {
    setBroken(text);
    setOpened((opened) => opened + 1);
  };
  const readFile = async (file: File) => {
    const text = await textOf(file);
    const { value } = readText(text);
    if (isObject(value)) {
      replace(value, "");
      setOrigin({ original: value, from: file.name, isOfFile: true });
    }
    open(isObject(value) ? undefined : text);
    setIsText((isText) => isText || !isObject(value));
  };
  const dropping = useDrop((file) => void readFile(file));
  const isBroken = isText && broken !== undefined;
  const isChanged = !same(document, original);
  const startOver = () => {
    replace(original, "");
    open(undefined);
  };
  return (
    <FormContext.Provider value={state}>
      <div class={dropping.isOver ? "scenario-form dropping" : "scenario-form"} {...dropping.handlers}>
        <p class="lead">
          Describe a channel, a flow that is released in it, and the bodies in its way. The drawing and the expected
          time follow what you enter; then run it.
        </p>
        <Toolbar
          preset={preset}
          isText={isText}
          setIsText={setIsText}
          undo={history.past.length > 0 ? () => setHistory(undone) : undefined}
          redo={history.future.length > 0 ? () => setHistory(redone) : undefined}
          startOver={isChanged || isBroken ? startOver : undefined}
          readFile={(file) => void readFile(file)}
        />
        <ToRun planned={plan.planned} />
        <div class="edit">
          <ViolationList />
          <DifferenceList from={from} />
          {isText ? (
            <JsonEditor
              key={opened}
              document={document}
              onDocument={(next) => replace(next, "text")}
              broken={broken}
              onBroken={setBroken}
              goTo={goTo}
            />
          ) : (
            <Sections />
          )}
        </div>
        <div class="beside">
          <SceneFigure />
          <div class="card outlook">
            <SubmitForm
              obstacle={obstacleOf(plan.violations.length, isBroken)}
              isBlocked={isBroken}
              onSubmitted={forget}
            />
            <PlanPanel plan={plan} />
          </div>
        </div>
      </div>
    </FormContext.Provider>
  );
}

/** Text of a file; empty if it cannot be read, which the editor says. */
async function textOf(file: File): Promise<string> {
  try {
    return await file.text();
  } catch {
    return "";
  }
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
