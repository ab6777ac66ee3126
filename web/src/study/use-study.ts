import { useMemo } from "preact/hooks";
import type { Answer } from "../parts/use-answer";
import type { ListedMember, StudyAnswers, StudyState } from "./documents";
import { MemberPages } from "./member-pages";
import { TaggedAnswer } from "./tagged";
import { useLive } from "./use-live";

/** A study with its answers so far and its members on the coarsest level. */
export interface SeenStudy {
  study: StudyState;
  answers: StudyAnswers;
  members: ListedMember[];
}

/** A study, kept up to date while it runs. */
export function useStudy(id: string): Answer<SeenStudy> {
  const read = useMemo(() => {
    const path = `v1/studies/${encodeURIComponent(id)}`;
    const study = new TaggedAnswer<StudyState>(path);
    const answers = new TaggedAnswer<StudyAnswers>(`${path}/answers`);
    const members = new MemberPages(id, 0);
    return async (signal: AbortSignal): Promise<SeenStudy> => ({
      study: await study.read(signal),
      answers: await answers.read(signal),
      members: await members.read(signal),
    });
  }, [id]);
  return useLive(read, ({ study }) => study.status === "running", [read]);
}
