import { useMemo, useState } from "preact/hooks";
import { figure } from "../parts/format";
import { useWidth } from "../parts/use-width";
import { DensityCanvas } from "./density-canvas";
import type { Place, Region, RestDistribution } from "./documents";
import { MapAxes, MapChannel, Start } from "./map-axes";
import { MapDots, type Rested, restedText } from "./map-dots";
import { type Surroundings, frameOf, labelsOf } from "./map-frame";
import { percent } from "./percent";
import { type MapScale, onMap } from "./scales";

/** Room for numbers and titles of the axes [px]. */
const LEFT = 58;
const BELOW = 40;
const TOP = 6;
const RIGHT = 12;
/** Number of line styles of regions. */
const STYLES = 5;

interface MapProps {
  body: number;
  rest: RestDistribution;
  rested: Rested[];
  around: Surroundings | undefined;
}

/** Map of resting places from above, to scale; the table of regions beside it says the same. */
export function RestMap({ body, rest, rested, around }: MapProps) {
  const [box, width] = useWidth<HTMLDivElement>();
  const [pointed, setPointed] = useState<Rested>();
  const field = width - LEFT - RIGHT;
  const scale = useMemo(
    () =>
      field > 40
        ? frameOf(
            rest,
            rested.map(({ place }) => place),
            around,
            field,
          )
        : undefined,
    [rest, rested, around, field],
  );
  const regions = useMemo(() => inner(rest.regions), [rest]);
  return (
    <figure class="map">
      <Legend regions={regions} rest={rest} hasStart={around?.start !== undefined} />
      <div ref={box} class="field" style={scale ? { height: `${TOP + scale.height + BELOW}px` } : {}}>
        {scale && (
          <>
            <DensityCanvas density={rest.density} scale={scale} />
            <svg
              width={width}
              height={TOP + scale.height + BELOW}
              role="group"
              aria-label={`Map of where body ${body} comes to rest, seen from above`}
            >
              <g transform={`translate(${LEFT} ${TOP})`}>
                <MapAxes scale={scale} ground={around?.ground ?? "channel"} />
                <Outlines regions={regions} scale={scale} />
                {around?.channel && <MapChannel channel={around.channel} scale={scale} />}
                {around?.start && (
                  <g class="ground">
                    <Start at={onMap(scale, around.start)} />
                  </g>
                )}
                <Atoms rest={rest} scale={scale} />
                <MapDots rested={rested} scale={scale} onPoint={setPointed} />
                <Labels regions={regions} scale={scale} />
              </g>
            </svg>
          </>
        )}
      </div>
      <figcaption class="quiet">
        {pointed
          ? `${restedText(pointed)}. Press it for its job.`
          : "Point at a dot, or step through them with the arrow keys, for its member."}
      </figcaption>
    </figure>
  );
}

/** Regions, the most probable place first. */
function inner(regions: Region[]): Region[] {
  return [...regions].sort((a, b) => a.probability - b.probability);
}

function Outlines({ regions, scale }: { regions: Region[]; scale: MapScale }) {
  return (
    <g class="regions" aria-hidden="true">
      {regions.map((region, number) => (
        <path key={region.probability} class={`region style-${number % STYLES}`} d={outline(region, scale)} />
      ))}
    </g>
  );
}

function outline(region: Region, scale: MapScale): string {
  const ring = (corners: number[][]) => {
    const places = corners.map((corner) =>
      onMap(scale, corner as Place)
        .map((px) => px.toFixed(1))
        .join(","),
    );
    return `M${places.join("L")}Z`;
  };
  return region.polygons.map(({ outer_m, holes_m }) => [outer_m, ...holes_m].map(ring).join("")).join("");
}

function Labels({ regions, scale }: { regions: Region[]; scale: MapScale }) {
  const outlines = regions.map((region) => ({
    text: percent(region.probability),
    corners: region.polygons.flatMap(({ outer_m }) => outer_m.map((corner) => onMap(scale, corner as Place))),
  }));
  return (
    <g class="labels" aria-hidden="true">
      {labelsOf(outlines).map(({ text, at: [x, y] }) => (
        <text key={text} x={Math.min(x, scale.width - 18)} y={y + 4} text-anchor="middle">
          {text}
        </text>
      ))}
    </g>
  );
}

function Atoms({ rest, scale }: { rest: RestDistribution; scale: MapScale }) {
  return (
    <g class="atoms" aria-hidden="true">
      {rest.atoms.map(({ place_m, share }) => {
        const [x, y] = onMap(scale, place_m as Place);
        return (
          <g key={String(place_m)}>
            <circle cx={x} cy={y} r={8} />
            <text x={x + 11} y={y - 6}>
              {percent(share)}
            </text>
          </g>
        );
      })}
    </g>
  );
}

function Legend({ regions, rest, hasStart }: { regions: Region[]; rest: RestDistribution; hasStart: boolean }) {
  const most = rest.density?.density_per_m2.reduce((most, value) => Math.max(most, value), 0);
  return (
    <ul class="legend">
      {regions.map((region, number) => (
        <li key={region.probability}>
          <svg width="30" height="12" aria-hidden="true">
            <line class={`region style-${number % STYLES}`} x1="1" x2="29" y1="6" y2="6" />
          </svg>
          {percent(region.probability)}
        </li>
      ))}
      {most !== undefined && (
        <li>
          <span class="shade" aria-hidden="true" /> density, 0 to {figure(most)} per m²
        </li>
      )}
      <li>
        <svg width="12" height="12" aria-hidden="true">
          <circle class="place" cx="6" cy="6" r="3" />
        </svg>{" "}
        a member
      </li>
      {hasStart && (
        <li>
          <svg width="16" height="16" aria-hidden="true">
            <path class="start" d="M1,8h14M8,1v14" />
          </svg>{" "}
          at the start
        </li>
      )}
      {rest.atoms.length > 0 && (
        <li>
          <svg width="18" height="18" aria-hidden="true">
            <circle class="atom" cx="9" cy="9" r="7" />
          </svg>{" "}
          many at one place
        </li>
      )}
    </ul>
  );
}
