/** Order and grouping of the fields. What is not named here is shown all the same, folded. */

import type { FieldSchema } from "../scenario/schema";

/** Fields that are always shown, by the name of their object's schema, in this order. */
const ESSENTIAL: Record<string, string[]> = {
  Scenario: ["channel", "terrain", "flow", "bodies", "duration_s", "title"],
  Channel: ["inclination_deg", "incline_length_m", "runout_length_m", "width_m"],
  Flow: ["volume_m3", "release", "releases"],
  Position: ["downstream_m", "lateral_m", "east_m", "north_m", "elevation_m"],
  Body: ["shape", "position", "yaw_deg", "fixed"],
};

/** Order of the fields of an object that are not named above, or of all if none are. */
const ORDER: Record<string, string[]> = {
  Terrain: ["height_map", "coordinates", "base_friction", "base_friction_map"],
  TerrainRelease: ["polygon_m", "thickness_m", "time_s", "thickness_map", "surface_map"],
  Body: ["density_kg_m3", "sphero_radius_m", "orientation", "velocity_m_s", "angular_velocity_rad_s", "motion"],
  Material: ["bulk_density_kg_m3", "grain_density_kg_m3", "grain_diameter_m", "static_friction", "limiting_friction"],
  Numerics: ["cell_size_m", "points_per_cell", "precision", "symmetry", "approach", "ending"],
};

/** Fields of the scenario that have a control of their own, by the pointer of their object. */
export const CONTROLLED: Record<string, string[]> = {
  "/accuracy": ["error_bars", "target", "quantity", "body"],
};

/** Fields of an object: those that are always shown, and those that are folded. */
export function arranged(schema: FieldSchema, omitted: string[] = []): { essential: string[]; rest: string[] } {
  const keys = Object.keys(schema.properties ?? {}).filter((key) => !omitted.includes(key));
  const wanted = ESSENTIAL[schema.name ?? ""];
  if (!wanted) return { essential: inOrder(keys, schema), rest: [] };
  return {
    essential: wanted.filter((key) => keys.includes(key)),
    rest: inOrder(
      keys.filter((key) => !wanted.includes(key)),
      schema,
    ),
  };
}

/** True of a field that is not folded in its object. */
export function isEssential(key: string, schema: FieldSchema | undefined): boolean {
  const wanted = ESSENTIAL[schema?.name ?? ""];
  return !wanted || wanted.includes(key);
}

/** Keys in the order of their object; what must be given comes first, what has no place last. */
function inOrder(keys: string[], { required = [], name = "" }: FieldSchema): string[] {
  const order = [...required, ...(ORDER[name] ?? [])];
  const place = (key: string) => (order.includes(key) ? order.indexOf(key) : order.length);
  return [...keys].sort((one, other) => place(one) - place(other));
}
