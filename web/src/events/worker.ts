/**
 * Shared worker that reads one stream of events for all open pages of this browser with the same
 * token: ten pages cost the service as much as one.
 */

import { type Connection, type ServiceEvent, type StreamMessage, follow } from "./stream";

interface SharedWorkerScope {
  onconnect: ((event: MessageEvent) => void) | null;
}

/** Message of a page: that it wants the events of a stream, said again as a sign of life, or leaves. */
export type PageMessage = { url: string; headers: Record<string, string> } | "leave";

/** Time after which a page that has said nothing is taken for closed [ms]; hidden pages have their
 * timers slowed down to one call a minute. */
const LONGEST_SILENCE_MS = 180_000;

/** The pages that share a stream. */
class SharedStream {
  private readonly pages = new Map<MessagePort, number>();
  private readonly end = new AbortController();
  /** Whether the stream has begun, which is told to all by a reset of its own. */
  private hasBegun = false;
  private connection: Connection | undefined;
  /** Last progress of each running job, for pages that come later. */
  private readonly progress = new Map<string, ServiceEvent>();

  constructor(url: string, headers: Record<string, string>, ended: () => void) {
    void follow(url, headers, (event) => this.tell(event), this.end.signal).finally(ended);
  }

  /** Adds a page, or notes that it is still there. */
  join(page: MessagePort): void {
    const isNew = !this.pages.has(page);
    this.pages.set(page, Date.now());
    // The opening of the stream is told to all pages that are there by then.
    if (!isNew) return;
    if (this.hasBegun) page.postMessage({ kind: "reset" } satisfies ServiceEvent);
    if (this.connection) page.postMessage(this.connection);
    for (const event of this.progress.values()) page.postMessage(event);
  }

  leave(page: MessagePort): void {
    this.pages.delete(page);
  }

  /** Leaves out closed pages; false once none is left and the stream has ended. */
  goesOn(): boolean {
    const oldest = Date.now() - LONGEST_SILENCE_MS;
    for (const [page, seen] of this.pages) if (seen < oldest) this.pages.delete(page);
    if (this.pages.size === 0) this.end.abort();
    return this.pages.size > 0;
  }

  private tell(message: StreamMessage): void {
    if (message.kind === "connected" || message.kind === "lost") this.connection = message;
    else this.note(message);
    for (const page of this.pages.keys()) page.postMessage(message);
  }

  private note(event: ServiceEvent): void {
    this.hasBegun = true;
    if (event.kind === "progress") this.progress.set(event.id, event);
    else if (event.kind === "reset") this.progress.clear();
    else this.progress.delete(event.id);
  }
}

const streams = new Map<string, SharedStream>();

function endUnused(): void {
  for (const [key, stream] of streams) if (!stream.goesOn()) streams.delete(key);
}

/** Leaves out a stream that was refused: the next sign of life of a page opens it again. */
function forget(key: string, stream: SharedStream): void {
  if (streams.get(key) === stream) streams.delete(key);
}

(self as unknown as SharedWorkerScope).onconnect = ({ ports: [page] }) => {
  if (!page) return;
  page.onmessage = ({ data }: MessageEvent<PageMessage>) => {
    if (data === "leave") {
      for (const stream of streams.values()) stream.leave(page);
      endUnused();
      return;
    }
    const key = JSON.stringify(data);
    const stream = streams.get(key) ?? new SharedStream(data.url, data.headers, () => forget(key, stream));
    streams.set(key, stream);
    stream.join(page);
  };
};

setInterval(endUnused, LONGEST_SILENCE_MS / 6);
