/** A request made of what a reader has filled in: its address, its headers, and the curl line. */

import { shellWord } from "../parts/shell";
import type { Parameter, Request } from "./contract";

/** Values of the parameters by their place and name; empty: left out. */
export type Values = Record<string, string>;

/** Key of a parameter's value. */
export function keyOf({ in: place, name }: Parameter): string {
  return `${place} ${name}`;
}

/** Path of a request with its parameters; a path parameter that is not given stays in braces. */
export function pathOf({ path, parameters }: Request, values: Values): string {
  let filled = path;
  const query = new URLSearchParams();
  for (const parameter of parameters ?? []) {
    const value = (values[keyOf(parameter)] ?? "").trim();
    if (value === "") continue;
    if (parameter.in === "path") filled = filled.replace(`{${parameter.name}}`, encodeURIComponent(value));
    if (parameter.in !== "query") continue;
    if ([parameter.schema.type].flat().includes("array") && parameter.explode !== false)
      for (const one of value.split(",")) query.append(parameter.name, one.trim());
    else query.append(parameter.name, value);
  }
  const text = query.toString().replaceAll("%2C", ",");
  return text === "" ? filled : `${filled}?${text}`;
}

/** Headers that are given as parameters, and that of the body. */
export function headersOf(request: Request, values: Values): Record<string, string> {
  const headers: Record<string, string> = {};
  if (request.requestBody) headers["Content-Type"] = Object.keys(request.requestBody.content)[0] ?? "application/json";
  for (const parameter of request.parameters ?? []) {
    const value = (values[keyOf(parameter)] ?? "").trim();
    if (parameter.in === "header" && value !== "") headers[parameter.name] = value;
  }
  return headers;
}

/** Line for a shell that makes the same request; the token is left to the shell. */
export function curlLine(
  request: Request,
  values: Values,
  body: string,
  { root, hasToken }: { root: string; hasToken: boolean },
): string {
  const parts = ["curl"];
  if (request.method !== "GET" && !(request.method === "POST" && body !== "")) parts.push(`-X ${request.method}`);
  if (streams(request)) parts.push("-N");
  for (const [name, value] of Object.entries(headersOf(request, values)))
    parts.push(`-H ${shellWord(`${name}: ${value}`)}`);
  if (!request.isOpen && hasToken) parts.push('-H "Authorization: Bearer $SCREE_TOKEN"');
  if (body !== "") parts.push(`--data ${shellWord(compact(body))}`);
  parts.push(shellWord(root + pathOf(request, values)));
  return parts.join(" ");
}

/** True if a request is answered by a stream of events. */
export function streams(request: Request): boolean {
  return request.responses["200"]?.content?.["text/event-stream"] !== undefined;
}

function compact(body: string): string {
  try {
    return JSON.stringify(JSON.parse(body));
  } catch {
    return body;
  }
}
