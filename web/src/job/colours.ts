/** Colours of bodies and of the flow's speed, the same as in the drawings of the service. */

const LIGHT = ["#c81010", "#006a8c", "#bc8a00", "#9c14c3", "#3e324b", "#4293ff"];
/** The same hues, light enough on a dark ground. */
const DARK = ["#ff6b62", "#3fb6d6", "#e6b43c", "#d885f5", "#b9aac9", "#86b8ff"];

/** Colour of a body or curve at this place; those after the last begin again. */
export function bodyColour(place: number, isDark: boolean): string {
  const colours = isDark ? DARK : LIGHT;
  return colours[place % colours.length] ?? "#888888";
}

/** Viridis at nine even places, which grows evenly in lightness. */
export const VIRIDIS: readonly (readonly [number, number, number])[] = [
  [68, 1, 84],
  [71, 44, 122],
  [59, 81, 139],
  [44, 113, 142],
  [33, 144, 141],
  [39, 173, 129],
  [92, 200, 99],
  [170, 220, 50],
  [253, 231, 37],
];

/** Colours of the scale that are told apart. */
const LEVELS = 128;
const SCALE = Array.from({ length: LEVELS }, (_, level) => mixed(level / (LEVELS - 1)));

/** Colour of a share of the scale, 0..1. */
export function viridis(share: number): string {
  return SCALE[Math.round(Math.min(1, Math.max(0, share)) * (LEVELS - 1))] ?? "#440154";
}

function mixed(share: number): string {
  const at = share * (VIRIDIS.length - 1);
  const low = Math.min(VIRIDIS.length - 2, Math.floor(at));
  const [a, b] = [VIRIDIS[low] ?? [0, 0, 0], VIRIDIS[low + 1] ?? [0, 0, 0]];
  const channel = (k: 0 | 1 | 2) => Math.round(a[k] + (b[k] - a[k]) * (at - low));
  return `rgb(${channel(0)} ${channel(1)} ${channel(2)})`;
}
