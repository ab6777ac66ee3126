/** Interval and estimate of a probability on a line from 0 to 100 %; the text beside it says the same. */
export function IntervalBar({
  lower,
  upper,
  estimate,
}: {
  lower: number;
  upper: number;
  estimate: number | null | undefined;
}) {
  const x = (share: number) => 4 + 152 * share;
  return (
    <svg class="interval" width="160" height="16" aria-hidden="true">
      <line class="axis" x1={x(0)} x2={x(1)} y1="8" y2="8" />
      <line class="range" x1={x(lower)} x2={x(upper)} y1="8" y2="8" />
      {estimate !== null && estimate !== undefined && <circle cx={x(estimate)} cy="8" r="4" />}
    </svg>
  );
}
