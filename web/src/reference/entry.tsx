import type { ComponentChildren } from "preact";
import { createContext } from "preact";
import { useContext, useEffect, useRef, useState } from "preact/hooks";

/** Anchor of the address: the entry of this name is open and in view. */
export const Anchor = createContext({ anchor: "", count: 0 });

/** An entry of the reference, whose contents are made when it is first opened. */
export function Entry({
  id,
  summary,
  children,
}: {
  id: string;
  summary: ComponentChildren;
  children: () => ComponentChildren;
}) {
  const { anchor, count } = useContext(Anchor);
  const element = useRef<HTMLDetailsElement>(null);
  const [isOpen, setIsOpen] = useState(anchor === id);
  useEffect(() => {
    if (anchor !== id) return;
    setIsOpen(true);
    element.current?.scrollIntoView({ block: "start" });
    element.current?.querySelector("summary")?.focus({ preventScroll: true });
  }, [anchor, count]);
  return (
    <details
      ref={element}
      id={id}
      class="entry"
      open={isOpen}
      onToggle={(event) => setIsOpen(event.currentTarget.open)}
    >
      <summary>{summary}</summary>
      {isOpen && <div class="contents">{children()}</div>}
    </details>
  );
}

/** A part of an entry that is made when it is first opened. */
export function Part({ summary, children }: { summary: ComponentChildren; children: () => ComponentChildren }) {
  const [isOpen, setIsOpen] = useState(false);
  return (
    <details open={isOpen} onToggle={(event) => setIsOpen(event.currentTarget.open)}>
      <summary>{summary}</summary>
      {isOpen && children()}
    </details>
  );
}
