/** Vectors, unit vectors and rotations as plain arrays. */

/** A vector or place [m]. */
export type Vector = readonly [number, number, number];

/** A unit quaternion, scalar first. */
export type Quaternion = readonly [number, number, number, number];

export const plus = (a: Vector, b: Vector, times = 1): Vector => [
  a[0] + times * b[0],
  a[1] + times * b[1],
  a[2] + times * b[2],
];
export const minus = (a: Vector, b: Vector): Vector => plus(a, b, -1);
export const scaled = (a: Vector, by: number): Vector => [a[0] * by, a[1] * by, a[2] * by];
export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const length = (a: Vector): number => Math.hypot(...a);
export const unit = (a: Vector): Vector => scaled(a, 1 / (length(a) || 1));

/** Sum of vectors. */
export const total = (vectors: readonly Vector[]): Vector =>
  vectors.reduce((sum, one) => plus(sum, one), [0, 0, 0] as Vector);

/** Rotation by an angle [rad] about a unit axis. */
export function rotation(axis: Vector, angle: number): Quaternion {
  return [Math.cos(angle / 2), ...scaled(axis, Math.sin(angle / 2))];
}

/** Rotation that makes `second` first and then `first`. */
export function product([a, ...u]: Quaternion, [b, ...v]: Quaternion): Quaternion {
  return [a * b - dot(u, v), ...plus(plus(scaled(v, a), u, b), cross(u, v))];
}

/** Vector turned by a rotation: v + 2 u × (u × v + w v). */
export function turned([w, ...axis]: Quaternion, v: Vector): Vector {
  return plus(v, cross(axis, plus(cross(axis, v), v, w)), 2);
}

/** Unit vector on the arc from one to the other. */
export function slerp(a: Vector, b: Vector, share: number): Vector {
  const angle = Math.acos(Math.min(1, Math.max(-1, dot(a, b))));
  if (angle < 1e-9) return a;
  return plus(scaled(a, Math.sin((1 - share) * angle) / Math.sin(angle)), b, Math.sin(share * angle) / Math.sin(angle));
}
