import { figure } from "../parts/format";
import type { Probability } from "./documents";

/** A share as percent. */
export function percent(share: number | null | undefined, digits = 3): string {
  return share === null || share === undefined ? "–" : `${figure(100 * share, digits)} %`;
}

/** An interval of shares: `8.7 % to 17.2 %`. */
export function percentRange(lower: number, upper: number): string {
  return `${percent(lower)} to ${percent(upper)}`;
}

/** A probability with its interval: `57.4 % (51.1 % to 63.6 %)`. */
export function probabilityText({ estimate, lower, upper }: Probability): string {
  return `${percent(estimate)} (${percentRange(lower, upper)})`;
}
