import { useEffect, useState } from "preact/hooks";
import type { Clock } from "./clock";

/** Pause between two changes of numbers that nobody could read faster [ms]. */
export const READING_MS = 120;

/** Shows a clock again at its changes, while it runs no more often than `pause` allows. */
export function useClock(clock: Clock, pause = 0): number {
  const [, setRound] = useState(0);
  useEffect(() => {
    let last = 0;
    return clock.onChange(() => {
      const now = performance.now();
      if (clock.isPlaying && now - last < pause) return;
      last = now;
      setRound((round) => round + 1);
    });
  }, [clock, pause]);
  return clock.time;
}

/** Time of a clock for numbers beside a picture. */
export function useReadableTime(clock: Clock): number {
  return useClock(clock, READING_MS);
}
