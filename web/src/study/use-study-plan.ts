import { useEffect, useState } from "preact/hooks";
import { type Schemas, request } from "../api/client";

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

/** Checks a text, and plans the study that it is, whenever typing pauses. */
export function useStudyPlan(text: string): CheckedStudy {
  const [checked, setChecked] = useState<CheckedStudy>({ isChecking: false });
  useEffect(() => {
    const fault = faultOf(text);
    if (fault !== undefined) {
      setChecked({ isChecking: false, fault });
      return;
    }
    const end = new AbortController();
    setChecked((before) => ({ ...before, isChecking: true }));
    const timer = setTimeout(() => {
      planOf(text, end.signal).then(
        (plan) => setChecked({ isChecking: false, plan }),
        (problem: unknown) => {
          if (!end.signal.aborted) setChecked({ isChecking: false, problem });
        },
      );
    }, PAUSE_MS);
    return () => {
      clearTimeout(timer);
      end.abort();
    };
  }, [text]);
  return checked;
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
