/** Streams of flow frames for tests, encoded as the service does. */

/** A frame with places and speeds in SI units. */
export interface PlainFrame {
  time: number;
  points?: number;
  thinning?: number;
  ranks: number[];
  positions: [number, number, number][];
  speeds: number[];
}

/** The stream with these frames. */
export function encoded(frames: PlainFrame[]): Buffer {
  const head = Buffer.alloc(16);
  head.write("SCREEFLO", "ascii");
  head.writeUInt32LE(1, 8);
  head.writeUInt32LE(frames.length, 12);
  return Buffer.concat([head, ...frames.map(frameBytes)]);
}

function frameBytes({
  time,
  ranks,
  positions,
  speeds,
  thinning = 1,
  points = ranks.length * thinning,
}: PlainFrame): Buffer {
  const bytes = Buffer.alloc(56 + 8 * Math.ceil((10 * ranks.length) / 8));
  bytes.writeDoubleLE(time, 0);
  bytes.writeBigUInt64LE(BigInt(points), 8);
  bytes.writeUInt32LE(ranks.length, 16);
  bytes.writeUInt32LE(thinning, 20);
  const axes = [0, 1, 2].map((axis) => positions.map((position) => position[axis] ?? 0));
  const low = axes.map((values) => values.reduce((a, b) => Math.min(a, b), Infinity));
  const extent = axes.map((values, axis) => values.reduce((a, b) => Math.max(a, b), -Infinity) - (low[axis] ?? 0));
  const fastest = speeds.reduce((a, b) => Math.max(a, b), 0);
  const finite = (value = 0) => (Number.isFinite(value) ? value : 0);
  [...low, ...extent, fastest].forEach((value, place) => bytes.writeFloatLE(finite(value), 24 + 4 * place));
  const share = (value: number, from: number, length: number) =>
    length > 0 ? Math.round((65_535 * (value - from)) / length) : 0;
  const planes = [
    ranks,
    ...axes.map((values, axis) => values.map((value) => share(value, low[axis] ?? 0, extent[axis] ?? 0))),
    speeds.map((speed) => share(speed, 0, fastest)),
  ];
  planes.forEach((plane, place) =>
    plane.forEach((value, k) => bytes.writeUInt16LE(value, 56 + 2 * (place * ranks.length + k))),
  );
  return bytes;
}

/** A block of points that slides down an incline of 45° and spreads on the floor, without physics. */
export function sliding(count: number, instants: number, end: number): PlainFrame[] {
  const side = Math.round(Math.cbrt(count / 5));
  const ranks = Array.from({ length: count }, (_, rank) => rank);
  return Array.from({ length: instants }, (_, instant) => {
    const time = (instant * end) / (instants - 1);
    const positions = ranks.map((rank): [number, number, number] => {
      const [i, j, k] = [Math.floor(rank / (side * side)), Math.floor(rank / side) % side, rank % side];
      const x = -0.14 + 0.12 * (i / (5 * side)) + (0.2 + (0.4 * i) / (5 * side)) * (time / end) ** 2;
      const height = (0.05 * k) / side / (1 + time / end);
      return [x, -0.05 + (0.1 * (j + 0.5)) / side, Math.max(0, -x) + height];
    });
    return { time, ranks, positions, speeds: ranks.map((rank) => (1.5 * time * (rank % 997)) / 997) };
  });
}
