/** Requests to the service that serves this page, typed by its contract. */

import createClient from "openapi-fetch";
import type { components, paths } from "./contract";
import { ServiceProblem, problemOf } from "./problem";
import { authorization } from "./token";

export type Schemas = components["schemas"];
export type Scenario = Schemas["Scenario"];
export type Job = Schemas["Job"];
export type JobSummary = Schemas["JobSummary"];
export type JobStatus = Schemas["JobStatus"];
export type Progress = Schemas["Progress"];
export type Outcome = Schemas["Outcome"];
export type Planned = Schemas["Planned"];
export type Trajectory = Schemas["Trajectory"];

/** Root of the service: this page may be served below a path. */
export const ROOT = new URL(".", document.baseURI).pathname;

const UNAUTHORIZED = new Set<() => void>();

/** Calls back whenever the service asks for a token; returns the end of that. */
export function onUnauthorized(listener: () => void): () => void {
  UNAUTHORIZED.add(listener);
  return () => UNAUTHORIZED.delete(listener);
}

/** A request that shows the token. Throws `ServiceProblem` for every answer that is no success. */
export async function request(path: string, init: RequestInit = {}): Promise<Response> {
  return send(new Request(ROOT + path.replace(/^\//, ""), init));
}

async function send(request: Request): Promise<Response> {
  for (const [name, value] of Object.entries(authorization())) request.headers.set(name, value);
  let response: Response;
  try {
    response = await fetch(request);
  } catch (error) {
    if (request.signal.aborted) throw error;
    throw new ServiceProblem(0, { detail: "the service does not answer" });
  }
  if (response.ok) return response;
  if (response.status === 401) for (const listener of UNAUTHORIZED) listener();
  throw await problemOf(response);
}

/** Typed requests: `api.GET("/v1/jobs/{id}", …)`. Its answers are always successes. */
export const api = createClient<paths>({ baseUrl: ROOT, fetch: send });

/** Data of a typed answer, which is there since problems are thrown. */
export async function data<T>(answer: Promise<{ data?: T }>): Promise<T> {
  return (await answer).data as T;
}

let contract: Promise<Contract> | undefined;

/** The OpenAPI document of the service, as far as this page reads it. */
export interface Contract {
  info: { title: string; version: string; description: string };
  paths: Record<string, Record<string, unknown>>;
  components: { schemas: Record<string, Schema>; examples?: Record<string, { value: unknown }> };
}

/** A JSON Schema, as far as the contract uses it. */
export interface Schema {
  $ref?: string;
  type?: string | string[];
  description?: string;
  default?: unknown;
  enum?: unknown[];
  oneOf?: Schema[];
  allOf?: Schema[];
  properties?: Record<string, Schema>;
  required?: string[];
  items?: Schema;
  minimum?: number;
  maximum?: number;
  exclusiveMinimum?: number;
  exclusiveMaximum?: number;
  minItems?: number;
  maxItems?: number;
  maxLength?: number;
  pattern?: string;
  "x-unit"?: string;
  examples?: unknown[];
  title?: string;
}

/** The contract, read once. */
export function readContract(): Promise<Contract> {
  contract ??= request("openapi.json").then((answer) => answer.json() as Promise<Contract>);
  contract.catch(() => (contract = undefined));
  return contract;
}
