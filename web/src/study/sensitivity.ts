/** Sensitivities as the rows of a tornado. */

import type { ListedMember, SensitivityMeasures } from "./documents";
import { quantityOf } from "./documents";

/** A bar: a value with its interval. */
export interface Bar {
  value: number;
  lower: number;
  upper: number;
}

/** Direction in which a quantity follows an input. */
export type Direction = "rises" | "falls" | "unclear";

/** Row of an input: its bars in the order of the legend, the last of which it is ranked by. */
export interface Row {
  input: number;
  bars: Bar[];
  direction: Direction;
}

/** Tornado of a quantity. */
export interface Tornado {
  /** Names of the bars. */
  bars: string[];
  /** What the bars measure. */
  axis: "share" | "effect";
  rows: Row[];
  /** What the numbers are made of. */
  basis: string;
}

/** Rows of a tornado, the largest bar first; directions of members of given correlation. */
export function tornado(measures: SensitivityMeasures, directions: Direction[]): Tornado {
  const ranked = (rows: Row[]) => rows.sort((a, b) => (b.bars.at(-1)?.value ?? 0) - (a.bars.at(-1)?.value ?? 0));
  const direction = (input: number) => directions[input] ?? "unclear";
  if ("sobol" in measures) {
    const { inputs, rows, rows_left_out } = measures.sobol;
    return {
      bars: ["alone (first order)", "with all interactions (total)"],
      axis: "share",
      rows: ranked(
        inputs.map((index, input) => ({ input, bars: [index.first_order, index.total], direction: direction(input) })),
      ),
      basis: `From ${rows} rows of the design${leftOut(rows_left_out)}.`,
    };
  }
  if ("first_order" in measures) {
    const { inputs, members, members_left_out } = measures.first_order;
    return {
      bars: ["alone (first order)"],
      axis: "share",
      rows: ranked(inputs.map((index, input) => ({ input, bars: [index.first_order], direction: direction(input) }))),
      basis: `From ${members} members${leftOut(members_left_out)}.`,
    };
  }
  const { inputs } = measures.elementary;
  return {
    bars: ["interaction and curvature (σ)", "mean size of the effect (μ*)"],
    axis: "effect",
    rows: ranked(
      inputs.map(({ mean, mean_size, deviation }, input) => ({
        input,
        bars: [deviation, mean_size].map(({ value, standard_error }) => ({
          value,
          lower: value - standard_error,
          upper: value + standard_error,
        })),
        direction: directionOfEffect(mean.value, mean_size.value),
      })),
    ),
    basis: `From ${Math.min(...inputs.map(({ effects }) => effects))} effects of each input${leftOut(Math.max(0, ...inputs.map(({ effects_left_out }) => effects_left_out)))}.`,
  };
}

function leftOut(count: number): string {
  return count > 0 ? `; ${count} left out, as a member lacks the quantity` : "";
}

/** Direction of elementary effects: clear if their mean is more than half of their mean size. */
export function directionOfEffect(mean: number, meanSize: number): Direction {
  if (Math.abs(mean) <= 0.5 * meanSize) return "unclear";
  return mean > 0 ? "rises" : "falls";
}

/** Directions in which a quantity follows the inputs, by the rank correlation with each. */
export function directions(
  members: ListedMember[],
  inputs: number,
  quantity: string,
  body: number | null | undefined,
): Direction[] {
  return Array.from({ length: inputs }, (_, input) => {
    const pairs = members.flatMap((member) => {
      const [x, y] = [member.values[input], quantityOf(member, quantity, body)];
      return typeof x === "number" && y !== undefined ? [[x, y] as const] : [];
    });
    return directionOf(pairs);
  });
}

/** Direction of pairs: clear if their rank correlation is beyond chance (two standard errors). */
export function directionOf(pairs: (readonly [number, number])[]): Direction {
  if (pairs.length < 5) return "unclear";
  const rho = correlation(ranks(pairs.map(([x]) => x)), ranks(pairs.map(([, y]) => y)));
  if (!(Math.abs(rho) > 2 / Math.sqrt(pairs.length - 1))) return "unclear";
  return rho > 0 ? "rises" : "falls";
}

/** Ranks, of equal values their mean rank. */
function ranks(values: number[]): number[] {
  const order = values.map((value, place) => ({ value, place })).sort((a, b) => a.value - b.value);
  const found = new Array<number>(values.length).fill(0);
  for (let from = 0; from < order.length;) {
    let to = from;
    while (order[to + 1]?.value === order[from]?.value) to += 1;
    for (let place = from; place <= to; place += 1) found[order[place]?.place ?? 0] = 0.5 * (from + to);
    from = to + 1;
  }
  return found;
}

function correlation(x: number[], y: number[]): number {
  const mean = (values: number[]) => values.reduce((sum, value) => sum + value, 0) / values.length;
  const [mx, my] = [mean(x), mean(y)];
  let [xy, xx, yy] = [0, 0, 0];
  x.forEach((value, place) => {
    const [dx, dy] = [value - mx, (y[place] ?? my) - my];
    xy += dx * dy;
    xx += dx * dx;
    yy += dy * dy;
  });
  return xy / Math.sqrt(xx * yy);
}
