import type { ComponentType } from "preact";
import { useEffect, useState } from "preact/hooks";
import { ProblemNotice } from "./problem-notice";

/** A view whose script is read when it is first shown. */
export function lazily<P extends object>(read: () => Promise<ComponentType<P>>): ComponentType<P> {
  let part: ComponentType<P> | undefined;
  return function Lazy(props: P) {
    const [, setIsRead] = useState(part !== undefined);
    const [problem, setProblem] = useState<unknown>();
    useEffect(() => {
      if (part) return;
      read().then(
        (component) => {
          part = component;
          setIsRead(true);
        },
        (error: unknown) => setProblem(error),
      );
    }, []);
    if (problem) return <ProblemNotice problem={problem} />;
    if (!part) return <p class="quiet">Reading …</p>;
    const Part = part;
    return <Part {...props} />;
  };
}
