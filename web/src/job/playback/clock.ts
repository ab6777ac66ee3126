/** Clock of a replay: the simulated time that all pictures of a view show. */

/** A time between 0 and an end, which may run. */
export class Clock {
  private now = 0;
  private last = 0;
  private playing = false;
  private frame = 0;
  private before: number | undefined;
  private readonly listeners = new Set<() => void>();
  /** Simulated seconds in a second. */
  rate = 1;
  loops = false;

  get time(): number {
    return this.now;
  }

  get end(): number {
    return this.last;
  }

  get isPlaying(): boolean {
    return this.playing;
  }

  /** Calls back at each change; returns the end of that. */
  onChange(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  /** Sets the end; a clock that stood at the old one stays there. */
  setEnd(end: number): void {
    this.last = end;
    this.setTime(Math.min(this.now, end));
  }

  setTime(time: number): void {
    this.now = Math.min(this.last, Math.max(0, time));
    this.tell();
  }

  setRate(rate: number): void {
    this.rate = rate;
    this.tell();
  }

  setLoops(loops: boolean): void {
    this.loops = loops;
    this.tell();
  }

  /** Runs, from the start if it stood at the end. */
  play(): void {
    if (this.playing || this.last <= 0) return;
    if (this.now >= this.last) this.now = 0;
    this.playing = true;
    this.before = undefined;
    this.frame = requestAnimationFrame(this.tick);
    this.tell();
  }

  pause(): void {
    cancelAnimationFrame(this.frame);
    this.playing = false;
    this.tell();
  }

  private readonly tick = (wall: number) => {
    // A page that was hidden, or a slow frame, must not make the flow jump.
    const elapsed = Math.min(0.25, (wall - (this.before ?? wall)) / 1000);
    this.before = wall;
    let next = this.now + elapsed * this.rate;
    if (next >= this.last) {
      if (this.loops) next %= this.last;
      else this.playing = false;
    }
    if (this.playing) this.frame = requestAnimationFrame(this.tick);
    this.setTime(next);
  };

  private tell(): void {
    for (const listener of this.listeners) listener();
  }
}
