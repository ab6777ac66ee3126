import { at } from "../parts/json-document";
import { resolved, schemaAt } from "../scenario/schema";
import { type Asked, askedOf, asking } from "./editing";
import { Violations } from "./field";
import { elementId, useForm, violationsWithin } from "./form-context";
import { nameOf } from "./words";

/** Stops of the slider: no interval, intervals, and targets from 20 % to 1 %. */
const STOPS: Asked[] = ["off", "error_bars", 0.2, 0.15, 0.1, 0.07, 0.05, 0.03, 0.02, 0.015, 0.01];

/** Slider of the accuracy that is asked of the answer. */
export function AccuracyControl() {
  const { schemas, document, violations, replace } = useForm();
  const asked = askedOf(document);
  const pointer = "/accuracy/target";
  return (
    <div class="accuracy">
      <label for={elementId(pointer)}>Accuracy of the answer</label>
      <input
        id={elementId(pointer)}
        type="range"
        min={0}
        max={STOPS.length - 1}
        step={1}
        value={stopOf(asked)}
        aria-valuetext={nameOfAsked(asked)}
        aria-invalid={violationsWithin(violations, "/accuracy").length > 0}
        aria-describedby={`help:${pointer} wrong:${pointer}`}
        onInput={({ currentTarget }) =>
          replace(asking(document, STOPS[Number(currentTarget.value)] ?? "off", schemas), pointer)
        }
      />
      <div class="ends" aria-hidden="true">
        <span>off</span>
        <strong>{nameOfAsked(asked)}</strong>
        <span>1 %</span>
      </div>
      <p class="help" id={`help:${pointer}`}>
        {costOf(asked)}
      </p>
      {typeof asked === "number" && <Quantity />}
      {["error_bars", "target"].map((key) => (
        <Violations key={key} pointer={`/accuracy/${key}`} />
      ))}
    </div>
  );
}

function stopOf(asked: Asked): number {
  if (typeof asked !== "number") return STOPS.indexOf(asked);
  const distance = (stop: Asked) => (typeof stop === "number" ? Math.abs(Math.log(stop / asked)) : Infinity);
  const nearest = Math.min(...STOPS.map(distance));
  return STOPS.findIndex((stop) => distance(stop) === nearest);
}

function nameOfAsked(asked: Asked): string {
  if (typeof asked === "number") return `within ${Number((100 * asked).toPrecision(3))} %`;
  return asked === "off" ? "no uncertainty" : "uncertainty intervals";
}

function costOf(asked: Asked): string {
  if (asked === "off") return "One run. The answer says nothing about its error.";
  const shown = "The plan shows what they take.";
  if (asked === "error_bars")
    return `Coarser runs before that of the answer give each quantity an uncertainty interval. ${shown}`;
  return `Runs with ever smaller cells until the interval is that narrow, or the budget is spent; cells half as large take about ten times as long. The target chooses the cell size. ${shown}`;
}

/** Quantity and body that the target is about. */
function Quantity() {
  const { schemas, document, edit } = useForm();
  const quantity = schemaAt("/accuracy/quantity", document, schemas);
  const names = quantity ? (resolved(quantity, schemas).enum ?? []) : [];
  const bodies = at(document, "/bodies");
  const count = Array.isArray(bodies) ? bodies.length : 0;
  const body = at(document, "/accuracy/body");
  return (
    <div class="fields">
      <div class="field">
        <label for={elementId("/accuracy/quantity")}>Quantity</label>
        <select
          id={elementId("/accuracy/quantity")}
          value={String(at(document, "/accuracy/quantity") ?? "")}
          aria-describedby="wrong:/accuracy/quantity"
          onChange={({ currentTarget }) => edit("/accuracy/quantity", currentTarget.value)}
        >
          {names.map((name) => (
            <option key={String(name)} value={String(name)}>
              {nameOf(name)}
            </option>
          ))}
        </select>
        <Violations pointer="/accuracy/quantity" />
      </div>
      <div class="field">
        <label for={elementId("/accuracy/body")}>Body</label>
        <select
          id={elementId("/accuracy/body")}
          value={String(body ?? 0)}
          aria-describedby="wrong:/accuracy/body"
          onChange={({ currentTarget }) =>
            edit("/accuracy/body", currentTarget.value === "0" ? undefined : Number(currentTarget.value))
          }
        >
          {Array.from({ length: Math.max(1, count, typeof body === "number" ? body + 1 : 0) }, (_, index) => (
            <option key={index} value={String(index)}>
              Body {index}
            </option>
          ))}
        </select>
        <Violations pointer="/accuracy/body" />
      </div>
    </div>
  );
}
