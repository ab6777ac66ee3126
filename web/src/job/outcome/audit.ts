/** The conservation audit as answers, with the bounds of docs/outcome.md. */

import type { Outcome, Schemas } from "../../api/client";
import { figure } from "../../parts/format";
import type { Ground } from "../../scenario/ground";

/** A figure of the audit. */
export interface AuditFigure {
  name: string;
  meaning: string;
  size: string;
  /** Whether it is within its bound; undefined if it has none. */
  isFine: boolean | undefined;
  bound: string;
}

type Key = keyof Schemas["Conservation"];

/** Where material points leave. */
const EXIT: Record<Ground, string> = { channel: "through the open end", terrain: "over the edge of the map" };

const figuresOn = (ground: Ground): { key: Key; name: string; meaning: string; from?: number }[] => [
  {
    key: "mass_error",
    name: "Mass balance",
    meaning: "relative error of the mass that is there or has left",
    from: 1e-9,
  },
  {
    key: "points_lost",
    name: "Points lost",
    meaning: `material points that vanished other than ${EXIT[ground]}`,
    from: 1,
  },
  {
    key: "momentum_residual",
    name: "Momentum balance",
    meaning: "largest relative difference between the momentum and what all forces brought in",
    from: 1e-6,
  },
  {
    key: "angular_momentum_residual",
    name: "Angular momentum balance",
    meaning: "the same of the angular momentum",
    from: 1e-6,
  },
  {
    key: "energy_residual",
    name: "Energy",
    meaning: "largest relative rise of mechanical energy: above 0, energy was made",
    from: 0.02,
  },
  {
    key: "max_overlap_ratio",
    name: "Overlap of flow and bodies",
    meaning: "deepest point in a body, over the sum of point radius and sphero radius",
    from: 1,
  },
  {
    key: "max_body_overlap_ratio",
    name: "Overlap of bodies",
    meaning: `deepest overlap of a body with ${ground === "channel" ? "a wall" : "the ground"} or a body, over the sphero radius`,
    from: 0.9,
  },
  {
    key: "penetration_corrections",
    name: "Penetration corrections",
    meaning: "times a material point had to be put out of a body",
  },
  {
    key: "angular_momentum_from_shifting",
    name: "Angular momentum from redistribution",
    meaning: "relative angular momentum that shifting points created; not part of the balance above",
  },
  { key: "points_outflow", name: "Points that left", meaning: `material points that left ${EXIT[ground]}` },
];

/** All figures of the audit, and the energy balance of the bodies. */
export function auditOf(outcome: Outcome, ground: Ground): AuditFigure[] {
  const { conservation } = outcome;
  const figures = figuresOn(ground).map(({ key, name, meaning, from }) =>
    judged(name, meaning, conservation[key], from),
  );
  const made = outcome.bodies.flatMap(({ energy }) => (energy ? [energy.made_share] : []));
  if (made.length > 0) {
    figures.push(
      judged(
        "Energy made in bodies",
        "largest energy that nothing accounts for, over the energy that moves the body; 1e-5 is usual, and above 0.01 the run ends",
        Math.max(...made),
      ),
    );
  }
  return figures;
}

function judged(name: string, meaning: string, value: number, from?: number): AuditFigure {
  return {
    name,
    meaning,
    size: figure(value, 2),
    isFine: from === undefined ? undefined : Math.abs(value) < from,
    bound: from === undefined ? "" : `worth a look from ${figure(from)}`,
  };
}

/** The audit in one sentence. */
export function verdictOf(figures: AuditFigure[]): string {
  const doubtful = figures.filter(({ isFine }) => isFine === false);
  if (doubtful.length === 0) return "Yes, as far as the audit tells: every figure with a bound is within it.";
  return `With care: ${doubtful.map(({ name }) => name.toLowerCase()).join(", ")} ${doubtful.length === 1 ? "is" : "are"} beyond the bound.`;
}
