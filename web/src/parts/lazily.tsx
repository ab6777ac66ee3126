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
        // A newer version of the service has parts of other names.
        () => setProblem(new Error("a part of this page could not be read: reload the page")),
      );
    }, []);
    if (problem !== undefined) return <ProblemNotice problem={problem} />;
    if (!part) return <p class="quiet">Reading …</p>;
    const Part = part;
    return <Part {...props} />;
  };
}
