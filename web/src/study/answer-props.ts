import type { ListedMember, Study } from "./documents";

/** What an answer is shown with. */
export interface AnswerProps {
  study: Study;
  /** All members on the coarsest level that the page has read. */
  members: ListedMember[];
  /** Those of them that count for probabilities. */
  draws: ListedMember[];
  /** True if the study has finer levels, so that answers are not of the members' own values. */
  hasLevels: boolean;
}
