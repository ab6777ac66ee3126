/** Scenarios to begin with: those of configs/scenarios. */

import baffles from "../../../configs/scenarios/baffles.json";
import ballAndCapsule from "../../../configs/scenarios/ball_and_capsule.json";
import boulderCluster from "../../../configs/scenarios/boulder_cluster.json";
import cubeInCubeDeepFlow from "../../../configs/scenarios/cube_in_cube_deep_flow.json";
import cubeInDeepFlow from "../../../configs/scenarios/cube_in_deep_flow.json";
import cubeInThinFlow from "../../../configs/scenarios/cube_in_thin_flow.json";
import cubesAndColumn from "../../../configs/scenarios/cubes_and_column.json";
import minimal from "../../../configs/scenarios/minimal.json";
import sourcePaper from "../../../configs/scenarios/source_paper.json";
import sourcePaperAskew from "../../../configs/scenarios/source_paper_askew.json";
import spinningCube from "../../../configs/scenarios/spinning_cube.json";
import tenCubes from "../../../configs/scenarios/ten_cubes.json";
import type { JsonObject } from "../parts/json-document";

/** A scenario to begin with. */
export interface Preset {
  /** Name in addresses: the file's. */
  name: string;
  label: string;
  scenario: JsonObject;
}

/** All presets, the simplest first. */
export const PRESETS: Preset[] = [
  { name: "minimal", label: "Minimal: one cube, everything else default", scenario: minimal },
  { name: "source_paper", label: "One cube", scenario: sourcePaper },
  { name: "source_paper_askew", label: "One cube, off the centre and turned", scenario: sourcePaperAskew },
  { name: "cube_in_thin_flow", label: "Thin flow", scenario: cubeInThinFlow },
  { name: "cube_in_cube_deep_flow", label: "Flow as deep as the cube", scenario: cubeInCubeDeepFlow },
  { name: "cube_in_deep_flow", label: "Deep flow", scenario: cubeInDeepFlow },
  { name: "baffles", label: "Baffles", scenario: baffles },
  { name: "ball_and_capsule", label: "Ball and capsules", scenario: ballAndCapsule },
  { name: "boulder_cluster", label: "Boulder cluster", scenario: boulderCluster },
  { name: "cubes_and_column", label: "Collapsing column", scenario: cubesAndColumn },
  { name: "ten_cubes", label: "Ten falling cubes", scenario: tenCubes },
  { name: "spinning_cube", label: "Spinning cube", scenario: spinningCube },
];

/** Preset of this name, if there is one. */
export function presetOf(name: string): Preset | undefined {
  return PRESETS.find((preset) => preset.name === name);
}

/** Preset's own title, or its label if it has none. */
export function titleOf({ scenario, label }: Preset): string {
  return typeof scenario["title"] === "string" ? scenario["title"] : label;
}
