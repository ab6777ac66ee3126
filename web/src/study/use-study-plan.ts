import { useEffect, useState } from "preact/hooks";
import { type Schemas, request } from "../api/client";
import { pauseAfter } from "../api/problem";
import { onTokenChange } from "../api/token";

export type PlannedStudy = Schemas["PlannedStudy"];

/** Pause in typing after which a study is checked [ms]: a check takes the service about a second. */
const PAUSE_MS = 700;

/** What is known of a text that is to be a study. */
export interface CheckedStudy {
  isChecking: boolean;
  plan?: PlannedStudy;
  /** Why the text is no JSON. */
  fault?: string;
  problem?: unknown;
}

/** Checks a text, and plans the study that it is, whenever typing pauses; a busy service is asked again. */
export function useStudyPlan(text: string): CheckedStudy {
  const [checked, setChecked] = useState<CheckedStudy>({ isChecking: false });
  const [round, setRound] = useState(0);
  useEffect(() => onTokenChange(() => setRound((round) => round + 1)), []);
  useEffect(() => {
    const fault = faultOf(text);
    if (fault !== undefined) {
      setChecked({ isChecking: false, fault });
      return;
    }
    const end = new AbortController();
    const check = async () => {
      const [answer, pauseS] = await answerTo(text, end.signal);
      if (end.signal.aborted) return;
      setChecked({ isChecking: false, ...answer });
      if (pauseS !== undefined) timer = setTimeout(() => void check(), 1000 * pauseS);
    };
    setChecked((before) => ({ ...before, isChecking: true }));
    let timer = setTimeout(() => void check(), PAUSE_MS);
    return () => {
      clearTimeout(timer);
      end.abort();
    };
  }, [text, round]);
  return checked;
}

/** What the service says, and the pause after which a busy one is asked again [s]. */
async function answerTo(
  text: string,
  signal: AbortSignal,
): Promise<[answer: Omit<CheckedStudy, "isChecking">, pauseS?: number | undefined]> {
  try {
    return [{ plan: await planOf(text, signal) }];
  } catch (problem) {
    return [{ problem }, pauseAfter(problem)];
  }
}

async function planOf(text: string, signal: AbortSignal): Promise<PlannedStudy> {
  const headers = { "Content-Type": "application/json" };
  const answer = await request("v1/study-plans", { method: "POST", headers, body: text, signal });
  return (await answer.json()) as PlannedStudy;
}

function faultOf(text: string): string | undefined {
  try {
    JSON.parse(text);
    return undefined;
  } catch (error) {
    return error instanceof Error ? error.message : String(error);
  }
}
