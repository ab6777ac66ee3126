import { useEffect, useRef, useState } from "preact/hooks";
import { type Planned, request } from "../api/client";
import { type FieldError, ServiceProblem, pauseAfter } from "../api/problem";
import { onTokenChange } from "../api/token";
import type { JsonObject } from "../parts/json-document";

/** Time without a change after which the plan is asked for [ms]. */
const PAUSE_MS = 500;

/** What the service says about the scenario. */
export interface PlanState {
  /** Latest plan; it may be that of an earlier state of the scenario. */
  planned: Planned | undefined;
  violations: FieldError[];
  /** Any other problem. */
  problem: unknown;
  isAsking: boolean;
  /** Seconds until a busy service is asked again; undefined if it is not busy. */
  waitS: number | undefined;
}

const NOTHING: PlanState = {
  planned: undefined,
  violations: [],
  problem: undefined,
  isAsking: false,
  waitS: undefined,
};

/** Asks for the plan of the document after each change. One request is in progress at a time. */
export function usePlan(document: JsonObject): PlanState {
  const [state, setState] = useState(NOTHING);
  const [round, setRound] = useState(0);
  const isFirst = useRef(true);
  const text = JSON.stringify(document);
  useEffect(() => onTokenChange(() => setRound((round) => round + 1)), []);
  useEffect(() => {
    const end = new AbortController();
    const pause = isFirst.current ? 0 : PAUSE_MS;
    isFirst.current = false;
    let again: ReturnType<typeof setTimeout> | undefined;
    const ask = async () => {
      setState((state) => ({ ...state, isAsking: true, waitS: undefined }));
      const { waitS, ...answer } = await answerTo(text, end.signal);
      if (end.signal.aborted) return;
      setState((state) => ({
        ...NOTHING,
        planned: waitS === undefined ? undefined : state.planned,
        violations: waitS === undefined ? [] : state.violations,
        waitS,
        ...answer,
      }));
      if (waitS !== undefined) again = setTimeout(() => void ask(), 1000 * waitS);
    };
    const first = setTimeout(() => void ask(), pause);
    setState((state) => ({ ...state, isAsking: true }));
    return () => {
      end.abort();
      clearTimeout(first);
      clearTimeout(again);
    };
  }, [text, round]);
  return state;
}

/** Answer of the service as a change of the state. */
async function answerTo(text: string, signal: AbortSignal): Promise<Partial<PlanState>> {
  const headers = { "Content-Type": "application/json" };
  try {
    const answer = await request("v1/plans", { method: "POST", headers, body: text, signal });
    return { planned: (await answer.json()) as Planned };
  } catch (problem) {
    if (!(problem instanceof ServiceProblem)) return { problem };
    const waitS = pauseAfter(problem);
    if (waitS !== undefined) return { problem: problem.status === 0 ? problem : undefined, waitS };
    return problem.violations.length > 0 ? { violations: problem.violations } : { problem };
  }
}
