/** Places from which a scene is seen. */

import { type PerspectiveCamera, Vector3 } from "three";
import type { Region } from "../region";

/** Names of the places, and directions from the scene to the camera. */
export const CAMERAS = {
  free: { name: "Oblique", from: new Vector3(0.35, -1, 0.62) },
  side: { name: "Side", from: new Vector3(0, -1, 0.08) },
  above: { name: "Above", from: new Vector3(0, -0.002, 1) },
  along: { name: "Along", from: new Vector3(1, 0, 0.35) },
} as const;

export type CameraName = keyof typeof CAMERAS;

/** Puts a camera where it sees all of a region from a direction, and returns the place it looks at. */
export function lookAt(camera: PerspectiveCamera, region: Region, from: Vector3): Vector3 {
  const corners = Array.from({ length: 8 }, (_, corner) => {
    const end = (bit: number, axis: 0 | 1 | 2) => (corner & bit ? region.high[axis] : region.low[axis]);
    return new Vector3(end(1, 0), end(2, 1), end(4, 2));
  });
  const back = from.clone().normalize();
  const right = new Vector3(0, 0, 1).cross(back).normalize();
  const up = back.clone().cross(right);
  const tangent = Math.tan((camera.fov * Math.PI) / 360);
  const centre = new Vector3(...region.low).add(new Vector3(...region.high)).multiplyScalar(0.5);
  let distance = distanceFor(corners, centre, { back, right, up }, tangent, camera.aspect);
  for (let round = 0; round < CENTRINGS; round += 1) {
    for (const axis of [right, up])
      centre.addScaledVector(axis, offset(corners, centre, back, axis, distance) * distance);
    distance = distanceFor(corners, centre, { back, right, up }, tangent, camera.aspect);
  }
  distance *= MARGIN;
  camera.position.copy(centre).addScaledVector(back, distance);
  camera.near = distance / 200;
  camera.far = 20 * distance;
  camera.updateProjectionMatrix();
  camera.lookAt(centre);
  return centre;
}

/** Rounds in which what is seen moves to the middle of the picture. */
const CENTRINGS = 4;
const MARGIN = 1.12;

/** Distance from which all corners are within the picture. */
function distanceFor(
  corners: Vector3[],
  centre: Vector3,
  axes: { back: Vector3; right: Vector3; up: Vector3 },
  tangent: number,
  aspect: number,
): number {
  const needed = corners.map((corner) => {
    const arm = corner.clone().sub(centre);
    return (
      arm.dot(axes.back) +
      Math.max(Math.abs(arm.dot(axes.right)) / (tangent * aspect), Math.abs(arm.dot(axes.up)) / tangent)
    );
  });
  return Math.max(...needed, 1e-6);
}

/** How far the middle of what is seen is off the picture's, as a tangent. */
function offset(corners: Vector3[], centre: Vector3, back: Vector3, axis: Vector3, distance: number): number {
  const seen = corners.map((corner) => {
    const arm = corner.clone().sub(centre);
    return arm.dot(axis) / Math.max(1e-3 * distance, distance - arm.dot(back));
  });
  return (Math.max(...seen) + Math.min(...seen)) / 2;
}
