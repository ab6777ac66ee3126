/** Bodies in a scene: one instanced mesh for each shape, and their trails. */

import {
  BufferAttribute,
  BufferGeometry,
  Float32BufferAttribute,
  Group,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  MeshLambertMaterial,
  Quaternion,
  Vector3,
} from "three";
import type { Scenario } from "../../api/client";
import { bodyColour } from "../colours";
import { type Poses, poseAt, sampleAt } from "../records/trajectories";
import { type Surface, surfaceOf } from "../../geometry/surface";
import { colourOf } from "./flow-points";

const ONE = new Vector3(1, 1, 1);
/** Bodies beyond which roundings are drawn with fewer triangles. */
const MANY = 60;

/** All bodies, at any time. */
export class Bodies {
  readonly group = new Group();
  private readonly meshes: { mesh: InstancedMesh; poses: Poses[] }[] = [];
  private readonly trail: LineSegments<BufferGeometry, LineBasicMaterial>;
  private readonly material = new MeshLambertMaterial({ vertexColors: true });

  constructor(
    scenario: Scenario,
    private readonly poses: Poses[],
    isDark: boolean,
  ) {
    const byShape = new Map<Surface, Poses[]>();
    for (const each of poses) {
      const given = scenario.bodies[each.body];
      if (!given) continue;
      const surface = surfaceOf(given, poses.length > MANY ? 2 : 4);
      byShape.set(surface, [...(byShape.get(surface) ?? []), each]);
    }
    for (const [surface, same] of byShape) this.add(scenario, surface, same, isDark);
    this.trail = new LineSegments(trailOf(poses, isDark), new LineBasicMaterial({ vertexColors: true }));
    this.trail.frustumCulled = false;
    this.group.add(this.trail);
  }

  /** Moves all to a time. */
  show(time: number): void {
    const matrix = new Matrix4();
    for (const { mesh, poses } of this.meshes) {
      for (const [place, each] of poses.entries()) {
        const pose = poseAt(each, time);
        if (!pose) continue;
        const [w, x, y, z] = pose.orientation;
        mesh.setMatrixAt(place, matrix.compose(new Vector3(...pose.position), new Quaternion(x, y, z, w), ONE));
      }
      mesh.instanceMatrix.needsUpdate = true;
    }
    const last = sampleAt(this.poses[0]?.time ?? [], time);
    this.trail.geometry.setDrawRange(0, 2 * last * this.poses.length);
  }

  dispose(): void {
    for (const { mesh } of this.meshes) {
      mesh.geometry.dispose();
      mesh.dispose();
    }
    this.material.dispose();
    this.trail.geometry.dispose();
    this.trail.material.dispose();
  }

  private add(scenario: Scenario, surface: Surface, poses: Poses[], isDark: boolean): void {
    const mesh = new InstancedMesh(geometryOf(surface), this.material, poses.length);
    mesh.frustumCulled = false;
    for (const [place, { body }] of poses.entries()) {
      mesh.setColorAt(place, colourOf(scenario.bodies[body]?.fixed ? "#8a8f96" : bodyColour(body, isDark)));
    }
    this.meshes.push({ mesh, poses });
    this.group.add(mesh);
  }
}

/** Geometry of a surface; round bodies have darker octants, so that one sees them turn. */
function geometryOf({ positions, normals, triangles, core }: Surface): BufferGeometry {
  const isRound = core.length <= 2;
  const shades = Array.from({ length: positions.length / 3 }, (_, place) => {
    const [x = 0, y = 0, z = 0] = positions.slice(3 * place, 3 * place + 3);
    return isRound && x * y * z < 0 ? 0.55 : 1;
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(positions, 3));
  geometry.setAttribute("normal", new Float32BufferAttribute(normals, 3));
  geometry.setAttribute(
    "color",
    new Float32BufferAttribute(
      shades.flatMap((shade) => [shade, shade, shade]),
      3,
    ),
  );
  geometry.setIndex(triangles);
  return geometry;
}

/** Trails of all bodies, sample after sample, so that a part of them is those up to a time. */
function trailOf(poses: Poses[], isDark: boolean): BufferGeometry {
  const samples = poses[0]?.time.length ?? 0;
  const places = new Float32Array(Math.max(0, samples - 1) * poses.length * 6);
  const colours = new Float32Array(places.length);
  const shades = poses.map(({ body }) => colourOf(bodyColour(body, isDark)).toArray());
  let at = 0;
  for (let sample = 1; sample < samples; sample += 1) {
    for (const [place, { position }] of poses.entries()) {
      const to = position[sample] ?? position[position.length - 1] ?? [0, 0, 0];
      places.set([...(position[sample - 1] ?? to), ...to], at);
      colours.set([...(shades[place] ?? []), ...(shades[place] ?? [])], at);
      at += 6;
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(places, 3));
  geometry.setAttribute("color", new BufferAttribute(colours, 3));
  return geometry;
}
