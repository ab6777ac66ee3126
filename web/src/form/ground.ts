/** The two grounds of a scenario: what of a document and of its schemas belongs to which. */

import type { Schema } from "../api/client";
import { type JsonObject, at, changed, isObject, member, parentOf } from "../parts/json-document";
import type { Ground } from "../scenario/ground";
import type { Schemas } from "../scenario/schema";
import { editedDocument } from "./editing";

/** Objects of which some fields belong to one ground alone, by the names of their schemas. */
type Owners = Record<"Scenario" | "Flow" | "Position", string[]>;

/** Fields that belong to one ground alone. */
const FIELDS: Record<Ground, Owners> = {
  channel: { Scenario: ["channel"], Flow: ["volume_m3", "release"], Position: ["downstream_m", "lateral_m"] },
  terrain: { Scenario: ["terrain"], Flow: ["releases"], Position: ["east_m", "north_m"] },
};

/** Those of them that must be given. */
const REQUIRED: Record<Ground, Owners> = {
  channel: { Scenario: ["channel"], Flow: ["volume_m3"], Position: [] },
  terrain: { Scenario: ["terrain"], Flow: ["releases"], Position: ["east_m", "north_m"] },
};

/** What a ground begins with. */
const STARTERS: Record<Ground, JsonObject> = {
  channel: {
    channel: { inclination_deg: 40, incline_length_m: 1, runout_length_m: 2 },
    flow: { volume_m3: 0.01 },
  },
  terrain: { terrain: {}, flow: { releases: [{}] } },
};

/** The ground that is not this one. */
export const otherThan = (ground: Ground): Ground => (ground === "channel" ? "terrain" : "channel");

/** Schemas of scenarios on this ground: without the fields of the other. */
export function schemasOn(ground: Ground, schemas: Schemas): Schemas {
  const foreign = FIELDS[otherThan(ground)];
  const owners = Object.keys(foreign) as (keyof Owners)[];
  const own = owners.map((name) => {
    const schema: Schema = schemas[name] ?? {};
    const kept = Object.entries(schema.properties ?? {}).filter(([key]) => !foreign[name].includes(key));
    const required = [...REQUIRED[ground][name], ...(schema.required ?? [])];
    return [name, { ...schema, properties: Object.fromEntries(kept), required }];
  });
  return { ...schemas, ...(Object.fromEntries(own) as Schemas) };
}

/** True if a document has fields of the other ground. */
export function hasOther(document: JsonObject, ground: Ground): boolean {
  return fieldsIn(document, otherThan(ground)).length > 0;
}

/** The document without the fields of the other ground. */
export function withoutOther(document: JsonObject, ground: Ground, schemas: Schemas): JsonObject {
  const fields = fieldsIn(document, otherThan(ground));
  return fields.reduce((next, pointer) => editedDocument(next, pointer, undefined, schemas), document);
}

/** The document on this ground, with the fields that another document has of it: of one that was on it before. */
export function onGround(document: JsonObject, ground: Ground, before: JsonObject | undefined, schemas: Schemas) {
  const from = before ?? STARTERS[ground];
  const bare = withoutOther(document, ground, schemas);
  return fieldsIn(from, ground).reduce((next, pointer) => {
    const value = at(from, pointer);
    return value !== undefined && hasRoom(next, pointer) ? changed(next, pointer, value) : next;
  }, bare);
}

/** Pointers of the fields of a ground that a document has. */
function fieldsIn(document: JsonObject, ground: Ground): string[] {
  const { Scenario, Flow, Position } = FIELDS[ground];
  const bodies = at(document, "/bodies");
  const positions = Array.isArray(bodies) ? bodies.map((_, index) => `/bodies/${index}/position`) : [];
  const within = (owner: string, keys: string[]) => keys.map((key) => member(owner, key));
  const all = [...within("", Scenario), ...within("/flow", Flow), ...positions.flatMap((at) => within(at, Position))];
  return all.filter((pointer) => at(document, pointer) !== undefined);
}

/** True if a document has the flow or the body whose field this is. */
function hasRoom(document: JsonObject, pointer: string): boolean {
  const owner = parentOf(pointer);
  return owner === "" || isObject(at(document, owner.endsWith("/position") ? parentOf(owner) : owner));
}
