/** Documents of studies, and what is read off them. */

import type { Schemas } from "../api/client";

export type Study = Schemas["Study"];
export type StudyState = Schemas["StudyState"];
export type StudySummary = Schemas["StudySummary"];
export type StudyAnswers = Schemas["StudyAnswers"];
export type StudyAnswer = Schemas["StudyAnswer"];
export type StudyQuestion = Schemas["StudyQuestion"];
export type StudyInput = Schemas["StudyInput"];
export type Distribution = Schemas["Distribution"];
export type Design = Schemas["Design"];
export type RestDistribution = Schemas["RestDistribution"];
export type Region = Schemas["Region"];
export type Probability = Schemas["Probability"];
export type SensitivityMeasures = Schemas["SensitivityMeasures"];
export type ListedMember = Schemas["ListedMember"];
export type FinishedMember = Schemas["FinishedMember"];

/** A place seen from above: downstream and across [m]. */
export type Place = [number, number];

/** True if a member's values count as draws of the inputs, so that probabilities are made of it. */
export function isDraw(design: Design, member: number, inputs: number): boolean {
  if ("saltelli" in design) return member % (inputs + 2) < 2;
  return !("morris" in design) && !("one_at_a_time" in design);
}

/** Outcome of a member whose run came to its end. */
export function finished(member: ListedMember): FinishedMember | undefined {
  const { outcome } = member;
  return outcome !== null && typeof outcome === "object" && "finished" in outcome ? outcome.finished : undefined;
}

/** Reason of a member's failure. */
export function reasonOfFailure(member: ListedMember): string | undefined {
  const { outcome } = member;
  return outcome !== null && typeof outcome === "object" && "failed" in outcome ? outcome.failed.reason : undefined;
}

/** Quantity of a member by name, of a body or, without one, of the whole run. */
export function quantityOf(member: ListedMember, name: string, body: number | null | undefined): number | undefined {
  const outcome = finished(member);
  if (outcome === undefined) return undefined;
  if (body === null || body === undefined) return outcome.quantities?.[name];
  const found = outcome.bodies?.[body];
  if (found === undefined) return undefined;
  const own: Record<string, number | undefined> = {
    rest_x_m: found.rest_m[0],
    rest_y_m: found.rest_m[1],
    rest_z_m: found.rest_m[2],
    buried_m: found.buried_m,
    moving: Number(found.moving),
    hit: Number(found.hit),
  };
  return name in own ? own[name] : found.quantities?.[name];
}

/** Place where a body of a member rests; none while it moves. */
export function restingPlace(member: ListedMember, body: number): Place | undefined {
  const found = finished(member)?.bodies?.[body];
  const [x, y] = found?.rest_m ?? [];
  return found && !found.moving && x !== undefined && y !== undefined ? [x, y] : undefined;
}

/** A member with the value of a quantity. */
export interface Valued {
  member: ListedMember;
  value: number;
}

/** Members whose quantity is known. */
export function valued(members: ListedMember[], name: string, body: number | null | undefined): Valued[] {
  return members.flatMap((member) => {
    const value = quantityOf(member, name, body);
    return value === undefined ? [] : [{ member, value }];
  });
}
