/** Places in the text of a JSON document that is being written. */

import { parentOf } from "./json-document";
import { readText } from "./json-text";

/** Selects the value at a JSON pointer, or the beginning of what it is missing from. */
export function selectValue(area: HTMLTextAreaElement, pointer: string): void {
  selectRange(area, rangeOfValue(area.value, pointer));
}

/** Range of characters of the value at a JSON pointer, or of the first one of what it is missing from. */
export function rangeOfValue(text: string, pointer: string): [from: number, to: number] {
  const { places } = readText(text);
  let here = pointer;
  while (here !== "" && !places.has(here)) here = parentOf(here);
  const [start, end] = places.get(here) ?? [0, 0];
  return here === pointer ? [start, end] : [start, start + 1];
}

/** Puts the selection there, in the middle of what is seen. */
export function selectRange(area: HTMLTextAreaElement, [start, end]: [number, number]): void {
  area.focus();
  area.setSelectionRange(start, end);
  const line = area.value.slice(0, start).split("\n").length;
  const height = Number.parseFloat(getComputedStyle(area).lineHeight) || 20;
  area.scrollTop = Math.max(0, (line - 10) * height);
}
