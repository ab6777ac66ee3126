import { useRef } from "preact/hooks";
import { useLocation } from "wouter-preact";
import { PRESETS, titleOf } from "./presets";

interface ToolbarProps {
  /** Name of the example that the form began with. */
  preset: string | undefined;
  isText: boolean;
  setIsText: (isText: boolean) => void;
  undo: (() => void) | undefined;
  redo: (() => void) | undefined;
  startOver: (() => void) | undefined;
  readFile: (file: File) => void;
}

/** Choice of what to begin with, and the means to go back. */
export function Toolbar({ preset, isText, setIsText, undo, redo, startOver, readFile }: ToolbarProps) {
  const [, navigate] = useLocation();
  const file = useRef<HTMLInputElement>(null);
  return (
    <div class="toolbar">
      <label class="example">
        <span>Begin with</span>
        <select value={preset ?? ""} onChange={({ currentTarget }) => navigate(`/new?preset=${currentTarget.value}`)}>
          {preset === undefined && <option value="">(not an example)</option>}
          {PRESETS.map((one) => (
            <option key={one.name} value={one.name} title={titleOf(one)}>
              {one.label}
            </option>
          ))}
        </select>
      </label>
      <button type="button" onClick={() => file.current?.click()}>
        Open a file …
      </button>
      <input
        ref={file}
        class="hidden"
        type="file"
        accept=".json,application/json"
        aria-label="Scenario file"
        tabIndex={-1}
        onChange={({ currentTarget }) => {
          const [chosen] = currentTarget.files ?? [];
          if (chosen) readFile(chosen);
          currentTarget.value = "";
        }}
      />
      <button type="button" disabled={!undo} onClick={undo}>
        Undo
      </button>
      <button type="button" disabled={!redo} onClick={redo}>
        Redo
      </button>
      <button type="button" disabled={!startOver} onClick={startOver}>
        Start over
      </button>
      <div class="choice" role="group" aria-label="Way of editing">
        <button type="button" aria-pressed={!isText} onClick={() => setIsText(false)}>
          Fields
        </button>
        <button type="button" aria-pressed={isText} onClick={() => setIsText(true)}>
          JSON
        </button>
      </div>
    </div>
  );
}
