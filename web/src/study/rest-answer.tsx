import { useMemo } from "preact/hooks";
import { readContract } from "../api/client";
import { figure } from "../parts/format";
import type { JsonObject } from "../parts/json-document";
import { useAnswer } from "../parts/use-answer";
import { type RestDistribution, restingPlace } from "./documents";
import type { AnswerProps } from "./answer-props";
import type { Rested } from "./map-dots";
import { surroundingsOf } from "./map-frame";
import { percent, probabilityText } from "./percent";
import { RestMap } from "./rest-map";

/** Answer where a body comes to rest: map, and table of the regions. */
export function RestAnswer({
  body,
  rest,
  study,
  draws,
  hasLevels,
}: AnswerProps & { body: number; rest: RestDistribution }) {
  const rested = useMemo(() => restedOf(draws, body), [draws, body]);
  const { value: contract } = useAnswer(readContract, []);
  const around = useMemo(
    () => contract && surroundingsOf(study.scenario as JsonObject, body, contract.components.schemas),
    [study, body, contract],
  );
  return (
    <>
      {rested.length === 0 && rest.regions.length === 0 ? (
        <p>No member has come to rest yet.</p>
      ) : (
        <RestMap body={body} rest={rest} rested={rested} around={around} />
      )}
      {hasLevels && (
        <p class="quiet">The dots are resting places in the coarsest cells; the regions are corrected to the finest.</p>
      )}
      {rest.regions.length > 0 && <RegionTable body={body} rest={rest} />}
      <ul>
        {rest.too_few_members_for.length > 0 && (
          <li>
            Too few members for the regions of {rest.too_few_members_for.map((share) => percent(share)).join(", ")}.
          </li>
        )}
        {rest.moving > 0 && <li>{rest.moving} still moved when their run ended: their places are not known.</li>}
        {rest.atoms.map(({ place_m: [x, y], share, members }) => (
          <li key={`${x} ${y}`}>
            {members} members ({percent(share)}) rest at x {figure(x, 4)} m, y {figure(y, 4)} m exactly.
          </li>
        ))}
        {rest.numerical_error_m && (
          <li>
            The finest cells may shift all places by ±{figure(rest.numerical_error_m[0], 2)} m along x and ±
            {figure(rest.numerical_error_m[1], 2)} m along y.
          </li>
        )}
      </ul>
    </>
  );
}

function restedOf(draws: AnswerProps["draws"], body: number): Rested[] {
  const rested = draws.flatMap((member) => {
    const place = restingPlace(member, body);
    return place ? [{ member, place }] : [];
  });
  // Arrow keys go along x.
  return rested.sort((a, b) => a.place[0] - b.place[0]);
}

function RegionTable({ body, rest }: { body: number; rest: RestDistribution }) {
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label={`Regions of body ${body}`}>
      <table>
        <caption class="hidden">Regions that hold body {body} at rest</caption>
        <thead>
          <tr>
            <th scope="col" class="number">
              Probability
            </th>
            <th scope="col" class="number">
              Area [m²]
            </th>
            <th scope="col" class="number">
              Standard error [m²]
            </th>
            <th scope="col" class="number">
              Members within (95 % interval)
            </th>
          </tr>
        </thead>
        <tbody>
          {rest.regions.map((region) => (
            <tr key={region.probability}>
              <th scope="row" class="number">
                {percent(region.probability)}
              </th>
              <td class="number">{figure(region.area_m2)}</td>
              <td class="number">{figure(region.area_standard_error_m2, 2)}</td>
              <td class="number">{probabilityText(region.members)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
