/** Pixels that a machine can fill while a scene moves. */

/** A frame that took longer than this was too slow, shorter than that fast enough for more [ms]. */
const SLOW_MS = 42;
const FAST_MS = 24;
/** Frames between two changes, so that one slow frame does not count. */
const FRAMES = 6;
const LEAST = 0.4;
/** A longer pause between frames is none of the machine's [ms]. */
const PAUSE_MS = 400;

/** Ratio of pixels that keeps a scene moving, learnt from how long frames take. */
export class Pace {
  private mean = 0;
  private since = 0;
  private last: number | undefined;
  private value: number;
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
    return this.mean > 0 ? 1000 / this.mean : 0;
  }

  /** Notes a frame drawn at this time; true if the ratio has changed. */
  note(now: number): boolean {
    const took = now - (this.last ?? -Infinity);
    this.last = now;
    this.frames += 1;
    if (took > PAUSE_MS) return false;
    this.mean = this.mean === 0 ? took : 0.8 * this.mean + 0.2 * took;
    this.since += 1;
    if (this.since < FRAMES) return false;
    const before = this.value;
    if (this.mean > SLOW_MS) this.value = Math.max(LEAST, 0.8 * before);
    else if (this.mean < FAST_MS) this.value = Math.min(this.most, 1.1 * before);
    if (this.value === before) return false;
    this.since = 0;
    return true;
  }
}
