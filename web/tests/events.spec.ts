import { expect, test } from "@playwright/test";
import { blocks, parse } from "../src/events/stream";

/** A body that comes in pieces of so many bytes. */
function body(text: string, length: number): ReadableStream<Uint8Array> {
  const bytes = new TextEncoder().encode(text);
  let at = 0;
  return new ReadableStream({
    pull(controller) {
      if (at >= bytes.length) controller.close();
      else controller.enqueue(bytes.slice(at, (at += length)));
    },
  });
}

const EVENTS =
  ':\n\nid: 7\nevent: status\ndata: {"id":"é€😀"}\n\nevent: progress\ndata: 1\ndata: 2\n\nid: 8\nevent: cut';

for (const [name, text] of [
  ["line feeds", EVENTS],
  ["carriage returns, too", EVENTS.replaceAll("\n", "\r\n")],
] as const) {
  test(`events are read however their stream is cut: ${name}`, async () => {
    for (const length of [1, 2, 3, 7, 1000]) {
      const messages = [];
      for await (const block of blocks(body(text, length))) messages.push(parse(block));
      expect(messages).toEqual([
        undefined,
        { id: "7", event: "status", data: '{"id":"é€😀"}' },
        { event: "progress", data: "1\n2" },
      ]);
    }
  });
}
