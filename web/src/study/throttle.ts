/** Calls a function when asked to, but never while it runs and at most once in so many milliseconds. */
export class Throttle {
  private last = -Infinity;
  private isRunning = false;
  private isWanted = false;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private hasEnded = false;

  constructor(
    private readonly call: () => Promise<unknown>,
    private readonly leastPauseMs: number,
  ) {}

  /** Calls the function, now or as soon as it may be. */
  ask(): void {
    if (this.hasEnded) return;
    this.isWanted = true;
    if (this.isRunning || this.timer !== undefined) return;
    const pause = Math.max(0, this.last + this.leastPauseMs - performance.now());
    this.timer = setTimeout(() => void this.run(), pause);
  }

  /** Ends it: nothing is called any more. */
  end(): void {
    this.hasEnded = true;
    clearTimeout(this.timer);
  }

  private async run(): Promise<void> {
    this.timer = undefined;
    this.isWanted = false;
    this.isRunning = true;
    try {
      await this.call();
    } finally {
      this.isRunning = false;
      this.last = performance.now();
      if (this.isWanted) this.ask();
    }
  }
}
