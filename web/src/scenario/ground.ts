/** Grounds that a scenario may have. */

/** A channel of incline and floor, or a height map. */
export type Ground = "channel" | "terrain";

/** Ground of a scenario, also of one that has none yet. */
export function groundOf(scenario: { terrain?: unknown }): Ground {
  return scenario.terrain === undefined || scenario.terrain === null ? "channel" : "terrain";
}
