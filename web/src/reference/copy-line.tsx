import { useEffect, useRef, useState } from "preact/hooks";

/** A line for a shell, with a button that copies it. */
export function CopyLine({ line, name }: { line: string; name: string }) {
  const text = useRef<HTMLPreElement>(null);
  const [said, setSaid] = useState("");
  useEffect(() => setSaid(""), [line]);
  const copy = async () => setSaid((await copied(line, text.current)) ? "Copied" : "Selected: copy it with Ctrl+C");
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

/** Copies a text; on a page without a secure address by selecting what is shown. */
async function copied(text: string, shown: Element | null): Promise<boolean> {
  // Only secure pages have a clipboard, whatever the types say.
  const clipboard = navigator.clipboard as Clipboard | undefined;
  if (clipboard) {
    try {
      await clipboard.writeText(text);
      return true;
    } catch {
      // The reader has not allowed it: there is the other way.
    }
  }
  if (shown) getSelection()?.selectAllChildren(shown);
  return document.execCommand("copy");
}
