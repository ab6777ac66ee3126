/** Decoder of the flow's frames, `application/vnd.scree.flow`, as they arrive. */

/** The flow at one instant: kept material points, quantised. */
export interface FlowFrame {
  /** Simulated time [s]. */
  time: number;
  /** Material points in the flow, kept or not. */
  points: number;
  /** One in this many points is kept. */
  thinning: number;
  kept: number;
  origin: Triple;
  extent: Triple;
  /** Speed that 65535 stands for [m/s]. */
  largestSpeed: number;
  /** Identifier of each kept point over `thinning`, ascending: the same in all frames. */
  rank: Uint16Array;
  x: Uint16Array;
  y: Uint16Array;
  z: Uint16Array;
  speed: Uint16Array;
}

export type Triple = [number, number, number];

/** What a quantised value is a share of. */
export const FULL = 65_535;

const STREAM_HEAD = 16;
const FRAME_HEAD = 56;
const PLANES = 5;
const MOST_KEPT = 65_536;
const MAGIC = "SCREEFLO";

/** Error of a stream that is no sequence of flow frames. */
export class FlowFormatError extends Error {
  constructor(detail: string) {
    super(`the flow's frames cannot be read: ${detail}`);
    this.name = "FlowFormatError";
  }
}

/** Decoder fed with the pieces of a stream, however it was cut. */
export class FlowDecoder {
  private rest = new Uint8Array(0);
  private pending = 0;
  private expected: number | undefined;
  private read = 0;

  /** Number of frames that the stream announced; undefined before its head has come. */
  get frames(): number | undefined {
    return this.expected;
  }

  /** Takes the next piece, and returns the frames that it completes. */
  push(piece: Uint8Array): FlowFrame[] {
    this.append(piece);
    const frames: FlowFrame[] = [];
    let at = this.expected === undefined ? this.readHead() : 0;
    while (this.expected !== undefined && this.read < this.expected) {
      const length = this.lengthOfFrame(at);
      if (length === undefined || this.pending - at < length) break;
      frames.push(frameOf(this.rest.slice(at, at + length)));
      at += length;
      this.read += 1;
    }
    if (this.expected !== undefined && this.read === this.expected && this.pending > at) {
      throw new FlowFormatError("there is more after the last frame");
    }
    this.rest.copyWithin(0, at, this.pending);
    this.pending -= at;
    return frames;
  }

  /** Checks that the stream ended with its last frame. */
  finish(): void {
    if (this.expected === undefined) throw new FlowFormatError("they broke off before the first one");
    if (this.read < this.expected) {
      throw new FlowFormatError(`they broke off after ${this.read} of ${this.expected}`);
    }
  }

  private append(piece: Uint8Array): void {
    const needed = this.pending + piece.length;
    if (needed > this.rest.length) {
      const larger = new Uint8Array(Math.max(needed, 2 * this.rest.length));
      larger.set(this.rest.subarray(0, this.pending));
      this.rest = larger;
    }
    this.rest.set(piece, this.pending);
    this.pending = needed;
  }

  private readHead(): number {
    const known = String.fromCharCode(...this.rest.subarray(0, Math.min(this.pending, MAGIC.length)));
    if (!MAGIC.startsWith(known)) throw new FlowFormatError("they do not begin as flow frames do");
    if (this.pending < STREAM_HEAD) return 0;
    const view = this.view();
    const version = view.getUint32(8, true);
    if (version !== 1) throw new FlowFormatError(`their version is ${version}, and 1 is known here`);
    this.expected = view.getUint32(12, true);
    return STREAM_HEAD;
  }

  private lengthOfFrame(at: number): number | undefined {
    if (this.pending - at < FRAME_HEAD) return undefined;
    const kept = this.view().getUint32(at + 16, true);
    if (kept > MOST_KEPT) throw new FlowFormatError(`frame ${this.read} says that it has ${kept} points`);
    return FRAME_HEAD + padded(2 * PLANES * kept);
  }

  private view(): DataView {
    return new DataView(this.rest.buffer, this.rest.byteOffset, this.pending);
  }
}

function padded(bytes: number): number {
  return Math.ceil(bytes / 8) * 8;
}

function frameOf(bytes: Uint8Array<ArrayBuffer>): FlowFrame {
  const view = new DataView(bytes.buffer);
  const float = (at: number) => view.getFloat32(at, true);
  const kept = view.getUint32(16, true);
  const plane = (place: number) => planeOf(view, FRAME_HEAD + 2 * kept * place, kept);
  const frame: FlowFrame = {
    time: view.getFloat64(0, true),
    points: Number(view.getBigUint64(8, true)),
    kept,
    thinning: view.getUint32(20, true),
    origin: [float(24), float(28), float(32)],
    extent: [float(36), float(40), float(44)],
    largestSpeed: float(48),
    rank: plane(0),
    x: plane(1),
    y: plane(2),
    z: plane(3),
    speed: plane(4),
  };
  check(frame);
  return frame;
}

/** A plane of values, whatever the byte order of this machine. */
function planeOf(view: DataView<ArrayBuffer>, start: number, length: number): Uint16Array {
  if (IS_LITTLE_ENDIAN) return new Uint16Array(view.buffer, start, length);
  return Uint16Array.from({ length }, (_, place) => view.getUint16(start + 2 * place, true));
}

const IS_LITTLE_ENDIAN = new Uint8Array(Uint16Array.of(1).buffer)[0] === 1;

function check(frame: FlowFrame): void {
  const numbers = [frame.time, ...frame.origin, ...frame.extent, frame.largestSpeed];
  if (!numbers.every(Number.isFinite)) throw new FlowFormatError("a frame has a number that is not finite");
  if (frame.thinning < 1) throw new FlowFormatError("a frame has a thinning of 0");
  for (let place = 1; place < frame.kept; place += 1) {
    if ((frame.rank[place] ?? 0) <= (frame.rank[place - 1] ?? 0)) {
      throw new FlowFormatError("the ranks of a frame do not ascend");
    }
  }
}
