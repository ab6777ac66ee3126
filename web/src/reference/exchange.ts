/** An exchange with the service: what was asked, and what came back. */

import { ROOT } from "../api/client";
import { authorization } from "../api/token";
import { blocks } from "../events/stream";
import { type Values, headersOf, pathOf } from "./asking";
import type { Request } from "./contract";

/** Body of an answer as it is shown. */
export type Shown = { kind: "text"; text: string; isCut: boolean } | { kind: "bytes"; blob: Blob } | { kind: "none" };

/** Answer of the service. */
export interface Received {
  status: number;
  statusText: string;
  /** Time until the answer's head, and until its end [ms]. */
  headMs: number;
  totalMs: number;
  headers: [name: string, value: string][];
  type: string;
  shown: Shown;
}

/** Characters of an answer that are shown. */
const LONGEST = 200_000;

/** Sends a request with the token of this tab, whatever the answer's status. */
export async function send(
  request: Request,
  values: Values,
  body: string,
  signal: AbortSignal,
): Promise<{ response: Response; began: number }> {
  const headers = { ...headersOf(request, values), ...authorization() };
  const began = performance.now();
  const init = { method: request.method, headers, signal, ...(body === "" ? {} : { body }) };
  return { response: await fetch(ROOT + pathOf(request, values).slice(1), init), began };
}

/** Reads an answer to its end. */
export async function receive({ response, began }: { response: Response; began: number }): Promise<Received> {
  const headMs = performance.now() - began;
  const type = response.headers.get("Content-Type") ?? "";
  const blob = await response.blob();
  return {
    status: response.status,
    statusText: response.statusText,
    headMs,
    totalMs: performance.now() - began,
    headers: [...response.headers],
    type,
    shown: await shownOf(blob, type),
  };
}

async function shownOf(blob: Blob, type: string): Promise<Shown> {
  if (blob.size === 0) return { kind: "none" };
  if (!/json|text|xml|csv/.test(type)) return { kind: "bytes", blob };
  const text = pretty(await blob.text(), type);
  return { kind: "text", text: text.slice(0, LONGEST), isCut: text.length > LONGEST };
}

function pretty(text: string, type: string): string {
  if (!/json/.test(type) || /ndjson/.test(type)) return text;
  try {
    return JSON.stringify(JSON.parse(text), null, 2);
  } catch {
    return text;
  }
}

/** Tells each message of a stream of events, as it was sent, until its end; a request that is stopped throws. */
export async function eachMessage(body: ReadableStream<Uint8Array>, tell: (message: string) => void): Promise<void> {
  // Lines that begin with a colon only keep the connection open.
  for await (const block of blocks(body)) if (/^[^:]/m.test(block)) tell(block);
}
