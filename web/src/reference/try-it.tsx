import { useEffect, useRef, useState } from "preact/hooks";
import { ROOT } from "../api/client";
import { onTokenChange, token } from "../api/token";
import { type Values, curlLine, streams } from "./asking";
import { bodyOf } from "./bodies";
import { type Interface, type Request, changesSomething } from "./contract";
import { CopyLine } from "./copy-line";
import { type Received, eachMessage, receive, send } from "./exchange";
import { ParameterFields } from "./parameter-fields";
import { ReceivedView } from "./received-view";

/** Events of a stream that are shown. */
const MOST_EVENTS = 50;

/** Form that sends a request and shows the answer, with the curl line that does the same. */
export function TryIt({ request, whole }: { request: Request; whole: Interface }) {
  const [values, setValues] = useState<Values>({});
  const [body, setBody] = useState(() => bodyOf(request, whole));
  const exchange = useExchange(request);
  const [hasToken, setHasToken] = useState(token() !== null);
  useEffect(() => onTokenChange(() => setHasToken(token() !== null)), []);
  const root = location.origin + ROOT.replace(/\/$/, "");
  return (
    <>
      <h4>curl</h4>
      <CopyLine
        line={curlLine(request, values, body, { root, hasToken })}
        name={`curl line of ${request.summary ?? request.id}`}
      />
      <h4>Try it</h4>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          void exchange.begin(values, body);
        }}
      >
        {request.parameters && (
          <ParameterFields parameters={request.parameters} values={values} onChange={setValues} named={whole.schema} />
        )}
        {request.requestBody && (
          <label>
            Body
            <textarea
              class="code"
              rows={Math.min(16, body.split("\n").length + 1)}
              spellcheck={false}
              value={body}
              onInput={(event) => setBody(event.currentTarget.value)}
            />
          </label>
        )}
        <div class="actions">
          <button type="submit" class={changesSomething(request) ? "changing" : "primary"} disabled={exchange.isGoing}>
            {changesSomething(request) ? `Send: this changes something (${request.method})` : "Send"}
          </button>
          {exchange.isGoing && (
            <button type="button" onClick={exchange.stop}>
              Stop
            </button>
          )}
        </div>
      </form>
      {exchange.failure && (
        <div class="notice problem" role="alert">
          {exchange.failure}
        </div>
      )}
      {exchange.events && <EventList events={exchange.events} isGoing={exchange.isGoing} />}
      {exchange.received && <ReceivedView received={exchange.received} name={fileName(request)} />}
    </>
  );
}

function fileName({ path, id }: Request): string {
  const last = path.slice(path.lastIndexOf("/") + 1);
  return last.includes(".") ? last : id;
}

function EventList({ events, isGoing }: { events: string[]; isGoing: boolean }) {
  return (
    <>
      <p role="status">
        {isGoing ? "The stream is open: " : "The stream is closed: "}
        {events.length} {events.length === 1 ? "event" : "events"} so far
        {events.length >= MOST_EVENTS && ", the first of them"}.
      </p>
      <pre class="body" tabIndex={0} aria-label="Events">
        {events.join("\n\n")}
      </pre>
    </>
  );
}

/** The exchange of a form. */
function useExchange(request: Request) {
  const [isGoing, setIsGoing] = useState(false);
  const [received, setReceived] = useState<Received>();
  const [events, setEvents] = useState<string[]>();
  const [failure, setFailure] = useState<string>();
  const end = useRef<AbortController>();
  useEffect(() => () => end.current?.abort(), []);
  const begin = async (values: Values, body: string) => {
    const own = (end.current = new AbortController());
    setIsGoing(true);
    setReceived(undefined);
    setEvents(undefined);
    setFailure(undefined);
    try {
      const sent = await send(request, values, body, own.signal);
      if (streams(request) && sent.response.status === 200 && sent.response.body) {
        setEvents([]);
        const count = (message: string) =>
          setEvents((before = []) => (before.length < MOST_EVENTS ? [...before, message] : before));
        await eachMessage(sent.response.body, count);
      } else setReceived(await receive(sent));
    } catch (error) {
      if (!own.signal.aborted) setFailure(error instanceof TypeError ? "The service does not answer." : String(error));
    } finally {
      if (end.current === own) setIsGoing(false);
    }
  };
  const stop = () => end.current?.abort();
  return { isGoing, received, events, failure, begin, stop };
}
