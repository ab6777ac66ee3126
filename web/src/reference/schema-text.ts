/** Schemas in words. */

import { figure } from "../parts/format";
import { type Schema, nameOfReference } from "./contract";

/** Kind of a value, such as `list of numbers`; references are shown as links, not here. */
export function kindOf(schema: Schema): string {
  if (schema.$ref) return nameOfReference(schema.$ref);
  if (schema.oneOf) return schema.oneOf.map(kindOf).join(" or ");
  if (schema.allOf) return schema.allOf.map(kindOf).join(" with ");
  const types = [schema.type ?? (schema.properties ? "object" : "any")].flat();
  return types
    .map((type) =>
      type === "array" ? `list of ${schema.items ? kindOf(schema.items) : "values"}` : withFormat(type, schema.format),
    )
    .join(" or ");
}

function withFormat(type: string, format: string | undefined): string {
  return type === "string" && format !== undefined ? `${type} (${format})` : type;
}

/** Range of a value or of its length, such as `0 ≤ x ≤ 89`; empty without one. */
export function rangeOf(schema: Schema): string {
  const { minimum, maximum, exclusiveMinimum, exclusiveMaximum, minItems, maxItems, maxLength } = schema;
  const low =
    minimum !== undefined
      ? `${exact(minimum)} ≤ `
      : exclusiveMinimum !== undefined
        ? `${exact(exclusiveMinimum)} < `
        : "";
  const high =
    maximum !== undefined
      ? ` ≤ ${exact(maximum)}`
      : exclusiveMaximum !== undefined
        ? ` < ${exact(exclusiveMaximum)}`
        : "";
  const parts = low || high ? [`${low}x${high}`] : [];
  if (minItems !== undefined && minItems === maxItems) parts.push(`${minItems} entries`);
  else if (minItems !== undefined || maxItems !== undefined)
    parts.push(`${minItems ?? 0} to ${maxItems ?? "any number of"} entries`);
  if (maxLength !== undefined) parts.push(`at most ${maxLength} characters`);
  return parts.join(", ");
}

function exact(value: number): string {
  return Math.abs(value) >= 1e6 ? figure(value, 17) : String(value).replace("-", "−");
}

/** Facts about a value: unit, range, default, allowed values. */
export function factsOf(schema: Schema): string[] {
  const facts: string[] = [];
  if (schema["x-unit"]) facts.push(`unit ${schema["x-unit"]}`);
  const range = rangeOf(schema);
  if (range) facts.push(range);
  if (schema.default !== undefined) facts.push(`default ${JSON.stringify(schema.default)}`);
  const values = schema.enum ?? schema.items?.enum;
  if (values) facts.push(`one of ${values.map((value) => JSON.stringify(value)).join(", ")}`);
  return facts;
}
