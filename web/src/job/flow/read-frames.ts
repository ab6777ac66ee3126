import { request } from "../../api/client";
import { FlowDecoder, type FlowFrame } from "./decoder";

/** Reads all frames of a job, and tells how many of how many there are as they come. */
export async function readFrames(
  id: string,
  tell: (read: number, of: number) => void,
  signal: AbortSignal,
): Promise<FlowFrame[]> {
  const response = await request(`v1/jobs/${id}/flow.bin`, { signal });
  const decoder = new FlowDecoder();
  const frames: FlowFrame[] = [];
  const reader = response.body?.getReader();
  try {
    for (;;) {
      const piece = await reader?.read();
      if (!piece || piece.done) break;
      frames.push(...decoder.push(piece.value));
      tell(frames.length, decoder.frames ?? 0);
    }
  } finally {
    void reader?.cancel();
  }
  decoder.finish();
  return frames;
}
