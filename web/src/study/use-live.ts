import { useEffect, useRef, useState } from "preact/hooks";
import { ServiceProblem } from "../api/problem";
import { onTokenChange } from "../api/token";
import { onServiceEvent } from "../events/events";
import type { Answer } from "../parts/use-answer";
import { Throttle } from "../parts/throttle";

/** Least time between two looks at a running study [ms]. */
const LEAST_PAUSE_MS = 2_000;
/** Time after which a look is due even if no event came: a study ends after its last job [ms]. */
const LONGEST_PAUSE_MS = 5_000;

/** Answers that asking again does not change: no token, not the reader's, not there. */
const FINAL = [401, 403, 404];

function isFinal(problem: unknown): boolean {
  return problem instanceof ServiceProblem && FINAL.includes(problem.status);
}

/** What a reader of answers found, read again after events of jobs while it `goesOn`. */
export function useLive<T>(
  read: (signal: AbortSignal) => Promise<T>,
  goesOn: (value: T) => boolean,
  depends: unknown[],
): Answer<T> {
  const [value, setValue] = useState<T>();
  const [problem, setProblem] = useState<unknown>();
  const again = useRef(() => {});
  useEffect(() => {
    const end = new AbortController();
    let isOver = false;
    const look = async () => {
      try {
        const found = await read(end.signal);
        if (end.signal.aborted) return;
        isOver = !goesOn(found);
        setValue(() => found);
        setProblem(undefined);
      } catch (error) {
        if (end.signal.aborted) return;
        isOver = isFinal(error);
        setProblem(error);
      }
    };
    const throttle = new Throttle(look, LEAST_PAUSE_MS);
    const ask = () => throttle.ask();
    again.current = ask;
    ask();
    // Of many open pages one is seen: the others look once they are.
    const askIfSeen = () => {
      if (!isOver && !document.hidden) ask();
    };
    const leaves = [
      onTokenChange(ask),
      onServiceEvent(({ kind }) => {
        if (kind !== "progress") askIfSeen();
      }),
    ];
    const backstop = setInterval(askIfSeen, LONGEST_PAUSE_MS);
    document.addEventListener("visibilitychange", askIfSeen);
    return () => {
      end.abort();
      throttle.end();
      clearInterval(backstop);
      document.removeEventListener("visibilitychange", askIfSeen);
      for (const leave of leaves) leave();
    };
  }, depends);
  return { value, problem, again: () => again.current() };
}
