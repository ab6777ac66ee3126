/** Pixels that a machine can fill while a scene moves. */

/** A frame that took longer than this was too slow, shorter than that fast enough for more [ms]. */
const SLOW_MS = 40;
const FAST_MS = 22;
/** Frames between two changes, so that one slow frame does not count. */
const FRAMES = 8;
/** Frames after which fewer pixels are tried again where they did not help. */
const PATIENCE = 120;
const LEAST = 0.5;
const STEP = 0.75;
/** Share of the time that fewer pixels must save to be kept. */
const GAIN = 0.08;
/** A longer pause between frames is none of the machine's [ms]. */
const PAUSE_MS = 400;

/** Ratio of pixels that keeps a scene moving, learnt from how long frames take. */
export class Pace {
  private took: number[] = [];
  private wait = FRAMES;
  private last: number | undefined;
  private value: number;
  /** Time of a frame before the last reduction [ms]. */
  private before: number | undefined;
  /** Pictures drawn so far. */
  frames = 0;

  constructor(private readonly most: number) {
    this.value = most;
  }

  get ratio(): number {
    return this.value;
  }

  /** Pictures per second of late. */
  get rate(): number {
    return this.took.length > 0 ? 1000 / mean(this.took) : 0;
  }

  /** Notes a frame drawn at this time [ms], and learns from it. */
  note(now: number): void {
    const took = now - (this.last ?? -Infinity);
    this.last = now;
    this.frames += 1;
    if (took > PAUSE_MS) return;
    this.took = [...this.took.slice(1 - FRAMES), took];
    this.wait -= 1;
    if (this.wait <= 0) this.adapt(median(this.took));
  }

  private adapt(took: number): void {
    this.wait = FRAMES;
    if (this.before !== undefined && took > (1 - GAIN) * this.before) {
      // Something else takes the time: pixels cost nothing.
      this.value = Math.min(this.most, this.value / STEP);
      this.before = undefined;
      this.wait = PATIENCE;
      return;
    }
    this.before = undefined;
    if (took > SLOW_MS && this.value > LEAST) {
      this.before = took;
      this.value = Math.max(LEAST, STEP * this.value);
    } else if (took < FAST_MS) this.value = Math.min(this.most, this.value / STEP);
  }
}

function mean(values: number[]): number {
  return values.reduce((sum, value) => sum + value, 0) / values.length;
}

function median(values: number[]): number {
  return [...values].sort((a, b) => a - b)[values.length >> 1] ?? 0;
}
