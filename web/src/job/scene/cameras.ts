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

/** Puts a camera where it sees all of a region from a direction, and returns the region's centre. */
export function lookAt(camera: PerspectiveCamera, region: Region, from: Vector3): Vector3 {
  const [low, high] = [new Vector3(...region.low), new Vector3(...region.high)];
  const centre = low.clone().add(high).multiplyScalar(0.5);
  const back = from.clone().normalize();
  const right = new Vector3(0, 0, 1).cross(back).normalize();
  const up = back.clone().cross(right);
  const tangent = Math.tan((camera.fov * Math.PI) / 360);
  let distance = 0;
  for (let corner = 0; corner < 8; corner += 1) {
    const place = new Vector3(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z).sub(centre);
    const reach = Math.max(Math.abs(place.dot(right)) / (tangent * camera.aspect), Math.abs(place.dot(up)) / tangent);
    distance = Math.max(distance, place.dot(back) + reach);
  }
  distance *= 1.06;
  camera.position.copy(centre).addScaledVector(back, distance);
  camera.near = distance / 200;
  camera.far = 20 * distance;
  camera.updateProjectionMatrix();
  camera.lookAt(centre);
  return centre;
}
