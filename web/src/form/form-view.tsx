import { useSearch } from "wouter-preact";
import { readContract } from "../api/client";
import { ProblemNotice } from "../parts/problem-notice";
import { useAnswer } from "../parts/use-answer";
import { useTitle } from "../parts/use-title";
import type { Schemas } from "../scenario/schema";
import { Editor } from "./editor";
import "./form.css";
import { PRESETS } from "./presets";
import { useSource } from "./use-source";

/** Form of a new scenario. */
export function FormView() {
  const contract = useAnswer(readContract, []);
  const schemas = contract.value?.components.schemas;
  useTitle("New scenario");
  return (
    <>
      <h1>New scenario</h1>
      {contract.problem !== undefined && !schemas && <ProblemNotice problem={contract.problem} />}
      {schemas ? <Begun schemas={schemas} /> : contract.problem === undefined && <p class="quiet">Reading …</p>}
    </>
  );
}

/** The editor, once what it begins with is known. */
function Begun({ schemas }: { schemas: Schemas }) {
  const search = useSearch();
  const { value: source, problem } = useSource(search, schemas);
  if (source?.search === search) {
    return <Editor key={search} address={search} begin={source.draft} schemas={schemas} preset={presetIn(search)} />;
  }
  if (problem === undefined) return <p class="quiet">Reading …</p>;
  return (
    <>
      <ProblemNotice problem={problem} />
      <p>
        <a href="#/new">Begin with an example</a>
      </p>
    </>
  );
}

/** Name of the example in the address; the first one if it names nothing. */
function presetIn(search: string): string | undefined {
  const query = new URLSearchParams(search);
  return query.get("preset") ?? (query.has("job") ? undefined : PRESETS[0]?.name);
}
