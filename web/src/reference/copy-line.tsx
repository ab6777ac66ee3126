import { useEffect, useRef, useState } from "preact/hooks";
import { copyText } from "../parts/copy-text";

/** A line for a shell, with a button that copies it. */
export function CopyLine({ line, name }: { line: string; name: string }) {
  const text = useRef<HTMLPreElement>(null);
  const [said, setSaid] = useState("");
  useEffect(() => setSaid(""), [line]);
  const copy = async () => setSaid((await copyText(line, text.current)) ? "Copied" : "Selected: copy it with Ctrl+C");
  return (
    <div class="copy">
      <pre ref={text} tabIndex={0} aria-label={name}>
        {line}
      </pre>
      <button type="button" onClick={() => void copy()} aria-label={`Copy: ${name}`}>
        Copy
      </button>
      <span role="status">{said}</span>
    </div>
  );
}
