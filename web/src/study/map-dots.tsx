import { useMemo, useRef } from "preact/hooks";
import { figure } from "../parts/format";
import type { ListedMember, Place } from "./documents";
import { type MapScale, onMap } from "./scales";

/** A member's resting place. */
export interface Rested {
  member: ListedMember;
  place: Place;
}

/** Text that names a resting place. */
export function restedText({ member, place: [x, y] }: Rested): string {
  return `Member ${member.member}: x ${figure(x, 4)} m, y ${figure(y, 4)} m`;
}

/** Resting places of the members, links to their jobs: one stop of the tab key, then arrow keys. */
export function MapDots({
  rested,
  scale,
  onPoint,
}: {
  rested: Rested[];
  scale: MapScale;
  onPoint: (rested: Rested | undefined) => void;
}) {
  const group = useRef<SVGGElement>(null);
  const dots = useMemo(
    () =>
      rested.map((one, number) => {
        const [x, y] = onMap(scale, one.place);
        return (
          <a
            key={one.member.member}
            href={`#/jobs/${one.member.job}`}
            tabIndex={number === 0 ? 0 : -1}
            aria-label={restedText(one)}
            data-number={number}
          >
            <circle class="grip" cx={x} cy={y} r={7} />
            <circle class="place" cx={x} cy={y} r={3} />
          </a>
        );
      }),
    [rested, scale],
  );
  const pointed = (event: Event) => onPoint(rested[numberOf(event.target)]);
  return (
    <g
      ref={group}
      class="dots"
      onKeyDown={(event) => group.current && move(group.current, event)}
      onFocusCapture={pointed}
      onBlurCapture={() => onPoint(undefined)}
      onMouseOver={pointed}
      onMouseOut={() => onPoint(undefined)}
    >
      {dots}
    </g>
  );
}

function numberOf(target: EventTarget | null): number {
  return Number((target as Element | null)?.closest("[data-number]")?.getAttribute("data-number") ?? -1);
}

const STEPS: Record<string, number> = {
  ArrowRight: 1,
  ArrowDown: 1,
  ArrowLeft: -1,
  ArrowUp: -1,
  Home: -Infinity,
  End: Infinity,
};

/** Moves the focus to the next dot in the order of the list, and the one stop of the tab key with it. */
function move(group: SVGGElement, event: KeyboardEvent): void {
  const step = STEPS[event.key];
  const links = group.querySelectorAll<SVGAElement>("a");
  if (step === undefined || links.length === 0) return;
  event.preventDefault();
  const from = numberOf(document.activeElement);
  const to = Math.min(Math.max(from + step, 0), links.length - 1);
  links[from]?.setAttribute("tabindex", "-1");
  links[to]?.setAttribute("tabindex", "0");
  links[to]?.focus();
}
