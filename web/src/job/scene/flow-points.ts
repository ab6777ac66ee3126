/** Material points of the flow as lit spheres, interpolated between two frames by the graphics card. */

import { BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, Points, ShaderMaterial, Vector3 } from "three";
import { VIRIDIS } from "../colours";
import type { FlowFrame } from "../flow/decoder";
import { type Between, framesAt, pairOf } from "../flow/frames";

const VERTEX = `
uniform vec3 originA, extentA, originB, extentB;
uniform float speedA, speedB, share, top, diameter, pixels;
uniform vec3 colours[${VIRIDIS.length}];
attribute vec4 start;
attribute vec4 end;
attribute float presence;
varying vec3 colour;
void main() {
  bool isFirst = presence == 1.0;
  bool isSecond = presence == 2.0;
  if ((isFirst && share >= 0.5) || (isSecond && share < 0.5)) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = 0.0;
    return;
  }
  vec3 a = isSecond ? originB + extentB * start.xyz : originA + extentA * start.xyz;
  vec3 b = isFirst ? originA + extentA * end.xyz : originB + extentB * end.xyz;
  float slow = start.w * (isSecond ? speedB : speedA);
  float fast = end.w * (isFirst ? speedA : speedB);
  float at = clamp(mix(slow, fast, share) / top, 0.0, 1.0) * ${(VIRIDIS.length - 1).toFixed(1)};
  int low = min(int(at), ${VIRIDIS.length - 2});
  colour = mix(colours[low], colours[low + 1], at - float(low));
  vec4 seen = modelViewMatrix * vec4(mix(a, b, share), 1.0);
  gl_Position = projectionMatrix * seen;
  gl_PointSize = max(1.5, diameter * pixels * projectionMatrix[1][1] / -seen.z);
}`;

const FRAGMENT = `
varying vec3 colour;
void main() {
  vec2 p = 2.0 * gl_PointCoord - 1.0;
  float r = dot(p, p);
  if (r > 1.0) discard;
  float light = 0.62 + 0.38 * dot(vec3(p.x, -p.y, sqrt(1.0 - r)), vec3(-0.36, 0.64, 0.68));
  gl_FragColor = vec4(colour * light, 1.0);
}`;

/** Diameter of a drawn point over the distance of neighbours: enough to leave no gaps. */
const TOUCHING = 1.35;

/** The flow in a scene. */
export class FlowPoints {
  readonly points: Points<BufferGeometry, ShaderMaterial>;
  private shown: Pick<Between, "first" | "second"> | undefined;
  private capacity = 0;

  constructor(
    private readonly frames: FlowFrame[],
    private readonly spacing: (thinning: number) => number,
    topSpeed: number,
  ) {
    const uniforms = {
      originA: { value: new Vector3() },
      extentA: { value: new Vector3() },
      originB: { value: new Vector3() },
      extentB: { value: new Vector3() },
      speedA: { value: 0 },
      speedB: { value: 0 },
      share: { value: 0 },
      top: { value: topSpeed },
      diameter: { value: 0.01 },
      pixels: { value: 400 },
      // As they are: the shader writes sRGB.
      colours: { value: VIRIDIS.map(([r, g, b]) => new Vector3(r / 255, g / 255, b / 255)) },
    };
    this.points = new Points(
      new BufferGeometry(),
      new ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms }),
    );
    this.points.frustumCulled = false;
  }

  /** Shows the flow at a time, in a picture half as high as so many pixels. */
  show(time: number, halfHeight: number): void {
    const between = framesAt(this.frames, time);
    // A flow may have no points, and then there is nothing to make room for.
    this.points.visible = between !== undefined && between.first.kept + between.second.kept > 0;
    if (!between || !this.points.visible) return;
    if (this.shown?.first !== between.first || this.shown.second !== between.second) this.upload(between);
    this.uniform("share").value = between.share;
    this.uniform("pixels").value = halfHeight;
  }

  dispose(): void {
    this.points.geometry.dispose();
    this.points.material.dispose();
  }

  private uniform(name: string): { value: unknown } {
    return this.points.material.uniforms[name] ?? { value: undefined };
  }

  private upload(between: Between): void {
    const { first, second } = between;
    const pair = pairOf(between);
    if (pair.count > this.capacity) this.grow(Math.ceil(1.2 * pair.count));
    const { geometry } = this.points;
    for (const name of ["start", "end", "presence"] as const) {
      const attribute = geometry.getAttribute(name) as BufferAttribute;
      (attribute.array as Uint16Array).set(pair[name].subarray(0, pair.count * attribute.itemSize));
      attribute.needsUpdate = true;
    }
    geometry.setDrawRange(0, pair.count);
    (this.uniform("originA").value as Vector3).set(...first.origin);
    (this.uniform("extentA").value as Vector3).set(...first.extent);
    (this.uniform("originB").value as Vector3).set(...second.origin);
    (this.uniform("extentB").value as Vector3).set(...second.extent);
    this.uniform("speedA").value = first.largestSpeed;
    this.uniform("speedB").value = second.largestSpeed;
    this.uniform("diameter").value = TOUCHING * this.spacing(first.thinning);
    this.shown = { first, second };
  }

  private grow(capacity: number): void {
    this.points.geometry.dispose();
    const geometry = new BufferGeometry();
    const attribute = (values: Uint16Array | Uint8Array, size: number, isShare: boolean) =>
      new BufferAttribute(values, size, isShare).setUsage(DynamicDrawUsage);
    geometry.setAttribute("start", attribute(new Uint16Array(4 * capacity), 4, true));
    geometry.setAttribute("end", attribute(new Uint16Array(4 * capacity), 4, true));
    geometry.setAttribute("presence", attribute(new Uint8Array(capacity), 1, false));
    // The renderer counts the points of a geometry by its positions, which this one does not use.
    geometry.setAttribute("position", geometry.getAttribute("start"));
    this.points.geometry = geometry;
    this.capacity = capacity;
  }
}

/** Colour of a CSS text. */
export function colourOf(css: string): Color {
  return new Color(css);
}
