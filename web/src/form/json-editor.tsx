import { useEffect, useRef, useState } from "preact/hooks";
import { type JsonObject, isObject, same } from "../parts/json-document";
import { type TextError, readText, written } from "../parts/json-text";
import { selectRange, selectValue } from "../parts/text-area";

interface JsonEditorProps {
  document: JsonObject;
  onDocument: (document: JsonObject) => void;
  /** Text that could not be read, to begin with. */
  broken: string | undefined;
  onBroken: (text: string | undefined) => void;
  /** Place to go to. */
  goTo: { pointer: string } | undefined;
}

/** The scenario as text. What is no JSON leaves the document as it was. */
export function JsonEditor({ document, onDocument, broken, onBroken, goTo }: JsonEditorProps) {
  const [typed, setTyped] = useState<string>(broken ?? written(document));
  const area = useRef<HTMLTextAreaElement>(null);
  const read = readText(typed);
  const error = read.error ?? notAnObject(typed, read.value);
  const text = error || same(read.value, document) ? typed : written(document);
  const input = (text: string) => {
    setTyped(text);
    const { value } = readText(text);
    onBroken(isObject(value) ? undefined : text);
    if (isObject(value)) onDocument(value);
  };
  useEffect(() => {
    if (goTo && area.current) selectValue(area.current, goTo.pointer);
  }, [goTo]);
  return (
    <div class="json-editor">
      <label for="json-text">The scenario as JSON</label>
      <p class="help" id="json-help">
        What is left out has its default. The fields and the drawing follow the text.
      </p>
      <textarea
        id="json-text"
        ref={area}
        class="code"
        rows={30}
        spellcheck={false}
        value={text}
        aria-describedby="json-help json-wrong"
        aria-invalid={error !== undefined}
        onInput={({ currentTarget }) => input(currentTarget.value)}
      />
      <div id="json-wrong" role="status">
        {error && (
          <p class="violation">
            Line {error.line}, column {error.column}: {error.message}.{" "}
            <button
              type="button"
              class="link"
              onClick={() => area.current && selectRange(area.current, [error.offset, error.offset])}
            >
              Go there
            </button>
          </p>
        )}
      </div>
    </div>
  );
}

function notAnObject(text: string, value: unknown): TextError | undefined {
  if (isObject(value as JsonObject)) return undefined;
  return {
    line: 1,
    column: 1,
    offset: 0,
    message: text.trim() === "" ? "there is nothing here" : "a scenario is an object, { … }",
  };
}
