import { useMemo, useState } from "preact/hooks";
import { ROOT, request } from "../api/client";
import { ProblemNotice } from "../parts/problem-notice";
import { useAnswer } from "../parts/use-answer";
import { Beginning } from "./beginning";
import { type Document, type Group, type Interface, type Schema, interfaceOf, schemaAnchor } from "./contract";
import { Anchor, Entry, Part } from "./entry";
import { useAnchor } from "./opened";
import { RequestView, paragraphs } from "./request-view";
import { Fields, InterfaceContext } from "./schema-view";
import { holds, textOfRequest, textOfSchema } from "./search";
import { TokenField } from "./token-field";

async function readInterface(): Promise<Interface> {
  return interfaceOf((await (await request("openapi.json")).json()) as Document);
}

/** Reference of the interface, made of the service's own contract. */
export function ReferencePage() {
  const { value: whole, problem } = useAnswer(() => readInterface(), []);
  return (
    <>
      <header class="bar">
        <a class="brand" href={ROOT}>
          <img src={`${ROOT}assets/icon.svg`} alt="" width="24" height="24" /> Scree
        </a>
        <nav aria-label="Pages">
          <a href={ROOT}>Back to the page</a>
          <a href={`${ROOT}openapi.json`}>openapi.json</a>
        </nav>
      </header>
      {whole ? (
        <Reference whole={whole} />
      ) : (
        <main>
          <h1>The interface</h1>
          {problem ? <ProblemNotice problem={problem} /> : <p class="quiet">Reading openapi.json …</p>}
        </main>
      )}
    </>
  );
}

function Reference({ whole }: { whole: Interface }) {
  const [sought, setSought] = useState("");
  const anchor = useAnchor();
  const groups = useMemo(() => filtered(whole.groups, sought), [whole, sought]);
  const schemas = useMemo(
    () => whole.schemas.filter(([name, schema]) => holds(textOfSchema(name, schema), sought)),
    [whole, sought],
  );
  const count = groups.reduce((sum, { requests }) => sum + requests.length, 0);
  return (
    <InterfaceContext.Provider value={whole}>
      <Anchor.Provider value={anchor}>
        <div class="reference">
          <Contents groups={groups} />
          <main id="main">
            <h1>{whole.info.title}: the interface</h1>
            {paragraphs(whole.info.description)}
            <p class="quiet">
              Version {whole.info.version}. This page is made of <a href={`${ROOT}openapi.json`}>openapi.json</a>, the
              contract (OpenAPI 3.1). Every answer has the header <code>X-Request-Id</code>, which the service's log
              has, too.
            </p>
            <Beginning />
            <h2>Requests</h2>
            <TokenField />
            <label class="search">
              Search requests and documents{" "}
              <input type="search" value={sought} onInput={(event) => setSought(event.currentTarget.value)} />
            </label>
            <p class="quiet" role="status">
              {count} {count === 1 ? "request" : "requests"}, {schemas.length}{" "}
              {schemas.length === 1 ? "document" : "documents"}
            </p>
            {groups.map((group) => (
              <GroupView key={group.name} group={group} whole={whole} />
            ))}
            <h2 id="documents">Documents</h2>
            {schemas.map(([name, schema]) => (
              <SchemaEntry key={name} name={name} schema={schema} />
            ))}
          </main>
        </div>
      </Anchor.Provider>
    </InterfaceContext.Provider>
  );
}

function filtered(groups: Group[], sought: string): Group[] {
  const kept = groups.map((group) => ({
    ...group,
    requests: group.requests.filter((request) => holds(textOfRequest(request), sought)),
  }));
  return kept.filter(({ requests }) => requests.length > 0);
}

function GroupView({ group: { name, description, requests }, whole }: { group: Group; whole: Interface }) {
  return (
    <section aria-labelledby={`group-${name}`}>
      <h3 id={`group-${name}`}>{name}</h3>
      <p>{description}</p>
      {requests.map((request) => (
        <RequestView key={request.id} request={request} whole={whole} />
      ))}
    </section>
  );
}

function SchemaEntry({ name, schema }: { name: string; schema: Schema }) {
  return (
    <Entry id={schemaAnchor(name)} summary={<code>{name}</code>}>
      {() => (
        <>
          {paragraphs(schema.description)}
          <Fields schema={schema} />
          <Part summary="As JSON Schema">
            {() => (
              <pre tabIndex={0} aria-label={`JSON Schema of ${name}`}>
                {JSON.stringify(schema, null, 2)}
              </pre>
            )}
          </Part>
        </>
      )}
    </Entry>
  );
}

function Contents({ groups }: { groups: Group[] }) {
  const [isOpen, setIsOpen] = useState(() => matchMedia("(min-width: 60rem)").matches);
  return (
    <nav class="contents-list" aria-label="Contents">
      <details open={isOpen} onToggle={(event) => setIsOpen(event.currentTarget.open)}>
        <summary>Contents</summary>
        <ul>
          <li>
            <a href="#beginning">To begin with</a>
          </li>
          {groups.map(({ name, requests }) => (
            <li key={name}>
              <a href={`#group-${name}`}>{name}</a>
              <ul>
                {requests.map(({ id, summary, method, path }) => (
                  <li key={id}>
                    <a href={`#${id}`} title={`${method} ${path}`}>
                      {summary}
                    </a>
                  </li>
                ))}
              </ul>
            </li>
          ))}
          <li>
            <a href="#documents">Documents</a>
          </li>
        </ul>
      </details>
    </nav>
  );
}
