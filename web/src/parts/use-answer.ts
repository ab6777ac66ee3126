import { useCallback, useEffect, useRef, useState } from "preact/hooks";
import { pauseAfter } from "../api/problem";
import { onTokenChange } from "../api/token";

/** An answer of the service that a view waits for, and the means to ask again. */
export interface Answer<T> {
  value: T | undefined;
  problem: unknown;
  again: () => void;
}

/**
 * Asks on first show, whenever `depends` change, after a change of the token, by `again`, and once
 * more after a while if the service was busy or did not answer.
 */
export function useAnswer<T>(ask: (signal: AbortSignal) => Promise<T>, depends: unknown[]): Answer<T> {
  const [value, setValue] = useState<T>();
  const [problem, setProblem] = useState<unknown>();
  const [round, setRound] = useState(0);
  const again = useCallback(() => setRound((round) => round + 1), []);
  const asking = useRef(ask);
  asking.current = ask;
  useEffect(() => onTokenChange(again), []);
  useEffect(() => {
    const end = new AbortController();
    let later: ReturnType<typeof setTimeout> | undefined;
    asking.current(end.signal).then(
      (answer) => {
        if (end.signal.aborted) return;
        setValue(() => answer);
        setProblem(undefined);
      },
      (error: unknown) => {
        if (end.signal.aborted) return;
        setProblem(error);
        const pauseS = pauseAfter(error);
        if (pauseS !== undefined) later = setTimeout(again, 1_000 * pauseS);
      },
    );
    return () => {
      end.abort();
      clearTimeout(later);
    };
  }, [round, ...depends]);
  return { value, problem, again };
}
