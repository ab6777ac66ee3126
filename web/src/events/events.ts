/** Events of the service, for the parts of this page that show jobs. */

import { ROOT } from "../api/client";
import { authorization, onTokenChange } from "../api/token";
import { type ServiceEvent, type StreamMessage, follow } from "./stream";
import type { PageMessage } from "./worker";

const listeners = new Set<(event: ServiceEvent) => void>();
const connectionListeners = new Set<(isLost: boolean) => void>();
let close: (() => void) | undefined;

/** Time between two signs of life to the shared worker [ms]. */
const SIGN_OF_LIFE_MS = 20_000;

/** Calls back at each event; returns the end of that. */
export function onServiceEvent(listener: (event: ServiceEvent) => void): () => void {
  listeners.add(listener);
  close ??= open();
  return () => listeners.delete(listener);
}

/** Calls back when the stream of events breaks off or is open again; returns the end of that. */
export function onConnection(listener: (isLost: boolean) => void): () => void {
  connectionListeners.add(listener);
  return () => connectionListeners.delete(listener);
}

onTokenChange(() => {
  close?.();
  close = listeners.size > 0 ? open() : undefined;
});

function tell(message: StreamMessage): void {
  if (message.kind === "connected" || message.kind === "lost") {
    for (const listener of connectionListeners) listener(message.kind === "lost");
  } else {
    for (const listener of listeners) listener(message);
  }
}

function open(): () => void {
  const url = `${ROOT}v1/events?progress=true`;
  const headers = authorization();
  if (typeof SharedWorker === "undefined") {
    const end = new AbortController();
    void follow(url, headers, tell, end.signal);
    return () => end.abort();
  }
  const worker = new SharedWorker(`${ROOT}assets/events.js`, { type: "module", name: "scree-events" });
  worker.port.onmessage = ({ data }: MessageEvent<StreamMessage>) => tell(data);
  const join = () => worker.port.postMessage({ url, headers } satisfies PageMessage);
  join();
  const signs = setInterval(join, SIGN_OF_LIFE_MS);
  const leave = () => worker.port.postMessage("leave" satisfies PageMessage);
  window.addEventListener("pagehide", leave);
  window.addEventListener("pageshow", join);
  return () => {
    clearInterval(signs);
    window.removeEventListener("pagehide", leave);
    window.removeEventListener("pageshow", join);
    leave();
    worker.port.close();
  };
}
