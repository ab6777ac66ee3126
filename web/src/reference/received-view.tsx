import { duration, size } from "../parts/format";
import { saveFile } from "../parts/save-file";
import type { Received } from "./exchange";

/** Answer of the service: status, time, headers and body. */
export function ReceivedView({ received, name }: { received: Received; name: string }) {
  const { status, statusText, totalMs, headers, shown } = received;
  return (
    <div class="received">
      <p role="status">
        <strong class={status < 400 ? "good" : "bad"}>
          {status} {statusText}
        </strong>{" "}
        after {duration(totalMs / 1000)}
      </p>
      <details>
        <summary>{headers.length} headers</summary>
        <pre tabIndex={0} aria-label="Headers of the answer">
          {headers.map(([name, value]) => `${name}: ${value}`).join("\n")}
        </pre>
      </details>
      {shown.kind === "none" && <p class="quiet">The answer has no body.</p>}
      {shown.kind === "text" && (
        <>
          <pre class="body" tabIndex={0} aria-label="Body of the answer">
            {shown.text}
          </pre>
          {shown.isCut && <p class="quiet">The rest is not shown.</p>}
        </>
      )}
      {shown.kind === "bytes" && (
        <p>
          {size(shown.blob.size)} of {received.type || "bytes"}{" "}
          <button type="button" onClick={() => saveFile(shown.blob, name)}>
            Save as {name}
          </button>
        </p>
      )}
    </div>
  );
}
