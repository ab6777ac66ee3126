/** Search in the requests and schemas of the interface. */

import type { Request, Schema } from "./contract";

/** True if a text holds every word that is looked for. */
export function holds(text: string, sought: string): boolean {
  const lower = text.toLowerCase();
  return sought
    .toLowerCase()
    .split(/\s+/)
    .every((word) => lower.includes(word));
}

/** Text of a request that is searched. */
export function textOfRequest({ method, path, operationId, summary, description, parameters, tags }: Request): string {
  const names = (parameters ?? []).map(({ name, description }) => `${name} ${description ?? ""}`);
  return [method, path, operationId, summary, description, ...(tags ?? []), ...names].join(" ");
}

/** Text of a schema that is searched. */
export function textOfSchema(name: string, schema: Schema): string {
  return [
    name,
    schema.description ?? "",
    ...Object.keys(schema.properties ?? {}),
    ...(schema.enum ?? []).map(String),
  ].join(" ");
}
