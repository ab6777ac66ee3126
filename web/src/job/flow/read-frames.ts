import { type Job, request } from "../../api/client";
import { FlowDecoder, type FlowFrame } from "./decoder";

/** Reader of a job's frames. It keeps what it has read, and asks only for what is new. */
export class FrameReader {
  private frames: FlowFrame[] = [];
  private attempt = 0;

  /** All frames so far; tells how many of how many there are as they come. */
  async read(job: Job, tell: (read: number, of: number) => void, signal: AbortSignal): Promise<FlowFrame[]> {
    if (job.attempt !== this.attempt) this.frames = [];
    this.attempt = job.attempt;
    const { frames } = this;
    const before = frames.length;
    const last = frames.at(-1);
    const query = last ? `?from_s=${justAfter(last.time)}` : "";
    const response = await request(`v1/jobs/${job.id}/flow.bin${query}`, { signal });
    const decoder = new FlowDecoder();
    for await (const piece of piecesOf(response)) {
      // A reading that has been given up must not add to what a later one reads.
      signal.throwIfAborted();
      frames.push(...decoder.push(piece));
      tell(frames.length, before + (decoder.frames ?? 0));
    }
    decoder.finish();
    return [...frames];
  }
}

async function* piecesOf(response: Response): AsyncGenerator<Uint8Array> {
  const reader = response.body?.getReader();
  try {
    for (;;) {
      const piece = await reader?.read();
      if (!piece || piece.done) return;
      yield piece.value;
    }
  } finally {
    // One that broke off has closed.
    reader?.cancel().catch(() => undefined);
  }
}

/** A time that no frame but a later one has. */
function justAfter(time: number): number {
  return time + Math.max(1e-15, 1e-12 * time);
}
