import { useEffect } from "preact/hooks";
import { useSearch } from "wouter-preact";
import { readContract } from "../api/client";
import { ProblemNotice } from "../parts/problem-notice";
import { useAnswer } from "../parts/use-answer";
import { Editor } from "./editor";
import "./form.css";
import { PRESETS } from "./presets";
import { useSource } from "./use-source";

/** Form of a new scenario. */
export function FormView() {
  const search = useSearch();
  const contract = useAnswer(readContract, []);
  const schemas = contract.value?.components.schemas;
  const source = useSource(search, schemas);
  const problem = contract.problem ?? source.problem;
  const begin = source.value;
  useEffect(() => {
    document.title = "New scenario – Scree";
    return () => {
      document.title = "Scree";
    };
  }, []);
  return (
    <>
      <h1>New scenario</h1>
      {problem !== undefined && (
        <>
          <ProblemNotice problem={problem} />
          <p>
            <a href="#/new">Begin with an example</a>
          </p>
        </>
      )}
      {problem === undefined && schemas && begin?.search === search ? (
        <Editor key={search} address={search} begin={begin.draft} schemas={schemas} preset={presetIn(search)} />
      ) : (
        problem === undefined && <p class="quiet">Reading …</p>
      )}
    </>
  );
}

/** Name of the example in the address; the first one if it names nothing. */
function presetIn(search: string): string | undefined {
  const query = new URLSearchParams(search);
  return query.get("preset") ?? (query.has("job") ? undefined : PRESETS[0]?.name);
}
