/** Words that are made of keys and texts of the service. */

const UNITS: [suffix: string, unit: string][] = [
  ["_rad_s", "rad/s"],
  ["_m_s2", "m/s²"],
  ["_m_s", "m/s"],
  ["_kg_m3", "kg/m³"],
  ["_m3", "m³"],
  ["_m2", "m²"],
  ["_deg", "°"],
  ["_pa", "Pa"],
  ["_kg", "kg"],
  ["_nm", "N m"],
  ["_n", "N"],
  ["_s", "s"],
  ["_m", "m"],
];

/** Unit that a key ends with; empty without one. */
export function unitOfKey(key: string): string {
  return UNITS.find(([suffix]) => key.endsWith(suffix))?.[1] ?? "";
}

/** Words of a key, without its unit: of `peak_speed_m_s` they are `peak speed`. */
export function wordsOfKey(key: string): string {
  const suffix = UNITS.find(([suffix]) => key.endsWith(suffix))?.[0] ?? "";
  return key.slice(0, key.length - suffix.length).replaceAll("_", " ");
}

/** A text with a capital letter first, and a full stop unless it ends otherwise. */
export function sentence(text: string): string {
  const whole = text.charAt(0).toUpperCase() + text.slice(1);
  return /[.:!?]$/.test(whole) ? whole : `${whole}.`;
}
