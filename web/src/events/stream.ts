/** The stream of events of the service, read with `fetch`, since `EventSource` shows no token. */

/** An event of the stream. */
export type ServiceEvent =
  | { kind: "status"; id: string; status: string; attempt: number }
  | { kind: "removed"; id: string; attempt: number }
  | { kind: "progress"; id: string; progress: unknown }
  /** Earlier knowledge may be wrong: the stream broke off or the database was restored. */
  | { kind: "reset" };

/** Whether the stream is open, told when that changes. */
export type Connection = { kind: "connected" } | { kind: "lost" };

/** What is told of a stream. */
export type StreamMessage = ServiceEvent | Connection;

/** Pause before the stream is opened again after it broke off [ms]. */
const PAUSE_MS = 1_000;

/** Time without a word after which a stream is taken for lost, as after a sleep of the machine [ms]: the service
 * says something every ten seconds. */
const LONGEST_SILENCE_MS = 35_000;

/** Reads the stream until the signal, and opens it again whenever it breaks off. */
export async function follow(
  url: string,
  headers: Record<string, string>,
  tell: (message: StreamMessage) => void,
  signal: AbortSignal,
): Promise<void> {
  let last: string | undefined;
  while (!signal.aborted) {
    try {
      const resumed = last === undefined ? {} : { "Last-Event-ID": last };
      const response = await fetch(url, { headers: { ...headers, ...resumed }, signal });
      // Asking again with the same token changes nothing.
      if (response.status === 401 || response.status === 403) return;
      if (response.ok && response.body) {
        tell({ kind: "connected" });
        // What happened while no stream was open is not told to a first one.
        if (last === undefined) tell({ kind: "reset" });
        for await (const message of messages(response.body)) {
          last = message.id ?? last;
          tell(eventOf(message));
        }
      }
    } catch {
      // Broken off, or not to be read: begun again, after the last event that was read.
      if (signal.aborted) return;
    }
    if (signal.aborted) return;
    tell({ kind: "lost" });
    await new Promise((resume) => setTimeout(resume, PAUSE_MS));
  }
}

interface Message {
  id?: string;
  event: string;
  data: string;
}

function eventOf({ event, data }: Message): ServiceEvent {
  if (event === "reset") return { kind: "reset" };
  return { kind: event, ...JSON.parse(data) } as ServiceEvent;
}

/** Messages of a body of server-sent events. */
async function* messages(body: ReadableStream<Uint8Array>): AsyncGenerator<Message> {
  for await (const block of blocks(body)) {
    const message = parse(block);
    if (message) yield message;
  }
}

/** Blocks of lines between blank lines, as they come; a proxy may have changed the ends of lines. */
export async function* blocks(body: ReadableStream<Uint8Array>): AsyncGenerator<string> {
  const reader = body.pipeThrough(new TextDecoderStream() as ReadableWritablePair<string, Uint8Array>).getReader();
  let rest = "";
  try {
    for (;;) {
      const { done, value } = await inTime(reader.read(), LONGEST_SILENCE_MS);
      if (done) return;
      const found = (rest + value).replaceAll("\r\n", "\n").split("\n\n");
      rest = found.pop() ?? "";
      yield* found;
    }
  } finally {
    // Otherwise the connection stays open after the reader has gone; one that broke off has closed.
    reader.cancel().catch(() => undefined);
  }
}

/** The value of a promise, or an error if it takes longer. */
async function inTime<T>(promise: Promise<T>, longestMs: number): Promise<T> {
  let timer: ReturnType<typeof setTimeout> | undefined;
  const end = new Promise<never>((_, reject) => {
    timer = setTimeout(() => reject(new Error("the stream is silent")), longestMs);
  });
  try {
    return await Promise.race([promise, end]);
  } finally {
    clearTimeout(timer);
  }
}

/** A message from its lines; none for a comment. */
export function parse(block: string): Message | undefined {
  const message: Message = { event: "message", data: "" };
  const data: string[] = [];
  for (const line of block.split("\n")) {
    const value = line.slice(line.indexOf(":") + 1).replace(/^ /, "");
    if (line.startsWith("id:")) message.id = value;
    else if (line.startsWith("event:")) message.event = value;
    else if (line.startsWith("data:")) data.push(value);
  }
  return data.length === 0 ? undefined : { ...message, data: data.join("\n") };
}
