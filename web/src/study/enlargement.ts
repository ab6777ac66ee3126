/** Larger designs that have the present one's members first. */

import type { Design } from "./documents";

/** What a design can grow by: its number now, its next size, and its name. */
export interface Growth {
  name: string;
  now: number;
  next: number;
  /** The design with this number. */
  to: (size: number) => Design;
}

/** Growth of a design; none of one that can't be enlarged by a number. */
export function growthOf(design: Design): Growth | undefined {
  if ("sobol" in design) {
    const { sobol } = design;
    return {
      name: "Members (a power of two)",
      now: sobol.members,
      next: 2 * sobol.members,
      to: (members) => ({ sobol: { ...sobol, members } }),
    };
  }
  if ("saltelli" in design) {
    const { saltelli } = design;
    const to = (base_members: number) => ({ saltelli: { ...saltelli, base_members } });
    return {
      name: "Rows of the design (a power of two)",
      now: saltelli.base_members,
      next: 2 * saltelli.base_members,
      to,
    };
  }
  if ("morris" in design) {
    const { morris } = design;
    const to = (trajectories: number) => ({ morris: { ...morris, trajectories } });
    return { name: "Trajectories", now: morris.trajectories, next: 2 * morris.trajectories, to };
  }
  return undefined;
}
