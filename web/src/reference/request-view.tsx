import { type Answer, type Content, type Header, type Interface, type Request, schemaAnchor } from "./contract";
import { Entry, Part } from "./entry";
import { Facts, Fields, Kind, Prose } from "./schema-view";
import { TryIt } from "./try-it";

/** A request of the interface. */
export function RequestView({ request, whole }: { request: Request; whole: Interface }) {
  const summary = (
    <>
      <code class={`method ${request.method.toLowerCase()}`}>{request.method}</code>{" "}
      <code class="path">{request.path}</code> <span>{request.summary}</span>
    </>
  );
  return (
    <Entry id={request.id} summary={summary}>
      {() => <Contents request={request} whole={whole} />}
    </Entry>
  );
}

function Contents({ request, whole }: { request: Request; whole: Interface }) {
  const { description, parameters, requestBody, responses, isOpen, id } = request;
  return (
    <>
      {paragraphs(description)}
      <p class="quiet">
        <a href={`#${id}`}>Link to this request</a>.{" "}
        {isOpen ? "It needs no access token." : "It needs an access token where the service has any."}
      </p>
      {parameters && <Parameters parameters={parameters} />}
      {requestBody &&
        Object.entries(requestBody.content).map(([type, { schema }]) => (
          <section key={type}>
            <h4>Body</h4>
            <p>
              <code>{type}</code> {schema && <Kind schema={schema} />}
            </p>
            {schema && <Part summary="Fields of the body">{() => <Fields schema={schema} />}</Part>}
          </section>
        ))}
      <h4>Answers</h4>
      <p class="quiet">
        Errors are <a href={`#${schemaAnchor("Problem")}`}>Problem</a> documents (<code>application/problem+json</code>
        ).
      </p>
      <ul class="answers">
        {Object.entries(responses).map(([status, answer]) => (
          <AnswerView key={status} status={status} answer={answer} whole={whole} />
        ))}
      </ul>
      <TryIt request={request} whole={whole} />
    </>
  );
}

/** A description, which may have several paragraphs. */
export function paragraphs(text: string | undefined) {
  return text?.split("\n\n").map((paragraph) => (
    <p key={paragraph}>
      <Prose text={paragraph} />
    </p>
  ));
}

function Parameters({ parameters }: { parameters: NonNullable<Request["parameters"]> }) {
  return (
    <>
      <h4>Parameters</h4>
      <ul class="fields">
        {parameters.map(({ name, in: place, required, schema, description }) => (
          <li key={place + name}>
            <code>{name}</code>{" "}
            <span class="kind">
              {place}, <Kind schema={schema} />
            </span>{" "}
            {required && <span class="needed">required</span>} <Facts schema={schema} description={description} />
          </li>
        ))}
      </ul>
    </>
  );
}

/** Header that every answer has; the page's beginning tells of it. */
const EVERYWHERE = "X-Request-Id";

function AnswerView({ status, answer, whole }: { status: string; answer: Answer; whole: Interface }) {
  const headers = Object.entries(answer.headers ?? {}).filter(([name]) => name !== EVERYWHERE);
  const isSuccess = status < "400";
  return (
    <li>
      <strong class={isSuccess ? "good" : "bad"}>{status}</strong> <Prose text={answer.description} />
      {headers.length > 0 && (
        <Part summary={`${headers.length === 1 ? "Header" : "Headers"}: ${headers.map(([name]) => name).join(", ")}`}>
          {() => <Headers headers={headers} />}
        </Part>
      )}
      {Object.entries(answer.content ?? {}).map(([type, content]) => (
        <ContentView key={type} type={type} content={content} example={whole.example(content)} isSuccess={isSuccess} />
      ))}
    </li>
  );
}

/** Content of an answer. All errors are of one kind, which is named once. */
function ContentView({
  type,
  content: { schema },
  example,
  isSuccess,
}: {
  type: string;
  content: Content;
  example: unknown;
  isSuccess: boolean;
}) {
  return (
    <div>
      {isSuccess && (
        <>
          <code>{type}</code> {schema && <Kind schema={schema} />}
        </>
      )}
      {isSuccess && schema?.$ref && <Part summary="Fields of the answer">{() => <Fields schema={schema} />}</Part>}
      {example !== undefined && <Part summary="Example">{() => <Example value={example} />}</Part>}
    </div>
  );
}

function Headers({ headers }: { headers: [name: string, header: Header][] }) {
  return (
    <ul class="fields">
      {headers.map(([name, { description, schema }]) => (
        <li key={name}>
          <code>{name}</code> <span class="kind">{schema && <Kind schema={schema} />}</span>{" "}
          <Facts schema={schema ?? {}} description={description} />
        </li>
      ))}
    </ul>
  );
}

function Example({ value }: { value: unknown }) {
  return (
    <pre class="body" tabIndex={0} aria-label="Example">
      {typeof value === "string" ? value : JSON.stringify(value, null, 2)}
    </pre>
  );
}
