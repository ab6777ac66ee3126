import { figure } from "../../parts/format";
import type { Clock } from "./clock";
import { READING_MS, useClock } from "./use-clock";

const RATES: [number, string][] = [
  [0.1, "1/10 of real speed"],
  [0.25, "1/4 of real speed"],
  [0.5, "1/2 of real speed"],
  [1, "real speed"],
  [2, "2 × real speed"],
  [5, "5 × real speed"],
  [20, "20 × real speed"],
];

/** Buttons and slider of a replay. */
export function Transport({ clock }: { clock: Clock }) {
  const time = useClock(clock, READING_MS);
  const label = clock.isPlaying ? "Pause" : "Play";
  return (
    <div class="transport" role="group" aria-label="Replay">
      <button
        type="button"
        class="play"
        onClick={() => (clock.isPlaying ? clock.pause() : clock.play())}
        disabled={clock.end <= 0}
      >
        {label}
      </button>
      <input
        type="range"
        min="0"
        max={clock.end}
        step={clock.end / 1000 || 1}
        value={time}
        aria-label="Simulated time"
        aria-valuetext={`${figure(time)} s of ${figure(clock.end)} s`}
        onInput={(event) => clock.setTime(Number(event.currentTarget.value))}
      />
      <span class="time">
        {time.toFixed(3)} s <span class="quiet">of {clock.end.toFixed(3)} s</span>
      </span>
      <select
        aria-label="Speed"
        value={clock.rate}
        onChange={(event) => clock.setRate(Number(event.currentTarget.value))}
      >
        {RATES.map(([rate, name]) => (
          <option key={rate} value={rate}>
            {name}
          </option>
        ))}
      </select>
      <label class="inline">
        <input
          type="checkbox"
          checked={clock.loops}
          onChange={(event) => clock.setLoops(event.currentTarget.checked)}
        />{" "}
        Loop
      </label>
    </div>
  );
}
