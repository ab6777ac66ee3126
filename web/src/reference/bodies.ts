/** Bodies to begin with, for requests whose contract has no example. */

import minimal from "../../../configs/scenarios/minimal.json";
import study from "../../../configs/studies/source_paper.json";
import { type Interface, type Request, nameOfReference } from "./contract";

const BODIES: Record<string, unknown> = {
  Scenario: minimal,
  Study: study,
  StudyChanges: { design: { sobol: { members: 2 * study.design.sobol.members, seed: study.design.sobol.seed } } },
};

/** Text of a body that a request may be sent with; empty if it takes none. */
export function bodyOf({ requestBody }: Request, { example }: Interface): string {
  const [content] = Object.values(requestBody?.content ?? {});
  if (!content) return "";
  const found = example(content) ?? BODIES[nameOfReference(content.schema?.$ref ?? "")] ?? {};
  return JSON.stringify(found, null, 2);
}
