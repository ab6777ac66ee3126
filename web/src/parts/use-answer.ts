import { useCallback, useEffect, useRef, useState } from "preact/hooks";
import { onTokenChange } from "../api/token";

/** An answer of the service that a view waits for, and the means to ask again. */
export interface Answer<T> {
  value: T | undefined;
  problem: unknown;
  again: () => void;
}

/** Asks on first show, whenever `depends` change, after a change of the token, and by `again`. */
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
    asking.current(end.signal).then(
      (answer) => {
        if (end.signal.aborted) return;
        setValue(() => answer);
        setProblem(undefined);
      },
      (error: unknown) => {
        if (!end.signal.aborted) setProblem(error);
      },
    );
    return () => end.abort();
  }, [round, ...depends]);
  return { value, problem, again };
}
