/** The OpenAPI document of the service as the reference reads it. */

import type { Schema as ContractSchema } from "../api/client";

/** A JSON Schema of the contract. */
export interface Schema extends ContractSchema {
  format?: string;
  additionalProperties?: boolean | Schema;
  items?: Schema;
  oneOf?: Schema[];
  allOf?: Schema[];
  properties?: Record<string, Schema>;
}

export interface Parameter {
  name: string;
  in: "path" | "query" | "header";
  description?: string;
  required?: boolean;
  schema: Schema;
  /** False if the values of a list are joined by commas. */
  explode?: boolean;
}

export interface Content {
  schema?: Schema;
  examples?: Record<string, { $ref?: string; value?: unknown }>;
}

export interface Header {
  description?: string;
  schema?: Schema;
}

export interface Answer {
  description: string;
  headers?: Record<string, Header>;
  content?: Record<string, Content>;
}

interface Operation {
  tags?: string[];
  summary?: string;
  description?: string;
  operationId: string;
  parameters?: Parameter[];
  requestBody?: { content: Record<string, Content>; description?: string };
  responses: Record<string, Answer>;
  security?: Record<string, string[]>[];
}

/** The OpenAPI document. */
export interface Document {
  info: { title: string; version: string; description: string };
  tags: { name: string; description?: string }[];
  paths: Record<string, Record<string, Operation>>;
  components: { schemas: Record<string, Schema>; examples?: Record<string, { value: unknown }> };
  security?: Record<string, string[]>[];
}

/** A request of the interface. */
export interface Request extends Operation {
  /** Its anchor on this page. */
  id: string;
  method: string;
  path: string;
  /** True if it may be asked for without a token wherever the service has tokens. */
  isOpen: boolean;
}

/** Requests of a tag. */
export interface Group {
  name: string;
  description: string;
  requests: Request[];
}

/** The interface: groups of requests in the order of the contract, and schemas by name. */
export interface Interface {
  info: Document["info"];
  groups: Group[];
  schemas: [name: string, schema: Schema][];
  schema: (reference: string) => Schema | undefined;
  example: (content: Content) => unknown;
}

/** The interface that a contract describes. */
export function interfaceOf(document: Document): Interface {
  const requests = Object.entries(document.paths).flatMap(([path, methods]) =>
    Object.entries(methods).map(([method, operation]) => requestOf(path, method, operation)),
  );
  const named = document.tags.map(({ name, description }) => ({
    name,
    description: description ?? "",
    requests: requests.filter(({ tags }) => tags?.[0] === name),
  }));
  const others = requests.filter(({ tags }) => !document.tags.some(({ name }) => name === tags?.[0]));
  const { schemas, examples } = document.components;
  return {
    info: document.info,
    groups: others.length > 0 ? [...named, { name: "others", description: "", requests: others }] : named,
    schemas: Object.entries(schemas),
    schema: (reference) => schemas[nameOfReference(reference)],
    example: ({ examples: own }) => {
      const [first] = Object.values(own ?? {});
      return first?.$ref ? examples?.[nameOfReference(first.$ref)]?.value : first?.value;
    },
  };
}

function requestOf(path: string, method: string, operation: Operation): Request {
  return {
    ...operation,
    id: operation.operationId,
    method: method.toUpperCase(),
    path,
    isOpen: operation.security?.length === 0,
  };
}

/** Last part of a reference, the name of what it refers to. */
export function nameOfReference(reference: string): string {
  return reference.slice(reference.lastIndexOf("/") + 1);
}

/** Anchor of a schema on this page. */
export function schemaAnchor(name: string): string {
  return `schema-${name}`;
}

/** True if a request may change what the service has. Plans are asked for with a body, but store nothing. */
export function changesSomething({ method, path }: Request): boolean {
  return method !== "GET" && !path.endsWith("plans");
}
