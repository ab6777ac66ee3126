/** Order and grouping of the fields. What is not named here is shown all the same, folded. */

import type { FieldSchema } from "./schema";

/** Fields that are always shown, by the name of their object's schema, in this order. */
const ESSENTIAL: Record<string, string[]> = {
  Scenario: ["channel", "flow", "bodies", "duration_s", "title"],
  Channel: ["inclination_deg", "incline_length_m", "runout_length_m", "width_m"],
  Flow: ["volume_m3", "release"],
  Position: ["downstream_m", "lateral_m", "elevation_m"],
  Body: ["shape", "position", "yaw_deg", "fixed"],
};

/** Fields of the scenario that have a control of their own, by the pointer of their object. */
export const CONTROLLED: Record<string, string[]> = {
  "/accuracy": ["error_bars", "target", "quantity", "body"],
};

/** Fields of an object: those that are always shown, and those that are folded. */
export function arranged(schema: FieldSchema, omitted: string[] = []): { essential: string[]; rest: string[] } {
  const keys = Object.keys(schema.properties ?? {}).filter((key) => !omitted.includes(key));
  const wanted = ESSENTIAL[schema.name ?? ""];
  if (!wanted) return { essential: requiredFirst(keys, schema), rest: [] };
  return {
    essential: wanted.filter((key) => keys.includes(key)),
    rest: keys.filter((key) => !wanted.includes(key)),
  };
}

/** True of a field that is not folded in its object. */
export function isEssential(key: string, schema: FieldSchema | undefined): boolean {
  const wanted = ESSENTIAL[schema?.name ?? ""];
  return !wanted || wanted.includes(key);
}

function requiredFirst(keys: string[], { required = [] }: FieldSchema): string[] {
  return [...keys.filter((key) => required.includes(key)), ...keys.filter((key) => !required.includes(key))];
}
