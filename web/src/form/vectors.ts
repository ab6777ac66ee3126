/** Vectors and rotations, as far as drawing bodies takes them. */

/** A vector or place [m]. */
export type Vec3 = [number, number, number];

/** A unit quaternion, scalar first. */
export type Quaternion = [number, number, number, number];

export const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const add = (a: Vec3, b: Vec3): Vec3 => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const minus = (a: Vec3, b: Vec3): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const times = (factor: number, a: Vec3): Vec3 => [factor * a[0], factor * a[1], factor * a[2]];
export const length = (a: Vec3): number => Math.hypot(...a);
export const unit = (a: Vec3): Vec3 => times(1 / length(a), a);
export const cross = (a: Vec3, b: Vec3): Vec3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** Rotation by an angle [rad] about a unit axis. */
export function rotation(axis: Vec3, angle: number): Quaternion {
  return [Math.cos(angle / 2), ...times(Math.sin(angle / 2), axis)];
}

/** Rotation that makes `second` first and then `first`. */
export function product(first: Quaternion, second: Quaternion): Quaternion {
  const [a, ...u] = first;
  const [b, ...v] = second;
  return [a * b - dot(u, v), ...add(add(times(a, v), times(b, u)), cross(u, v))];
}

/** The vector turned by the rotation. */
export function turned([w, ...u]: Quaternion, v: Vec3): Vec3 {
  const twice = times(2, cross(u, v));
  return add(add(v, times(w, twice)), cross(u, twice));
}
