import { Link } from "wouter-preact";
import { ProblemNotice } from "../parts/problem-notice";
import { useTitle } from "../parts/use-title";
import { AnswersView } from "./answers-view";
import { StudyFiles } from "./downloads";
import { EnlargeForm } from "./enlarge-form";
import { InputsTable } from "./inputs-table";
import { LevelsTable } from "./levels-table";
import { MembersTable } from "./members-table";
import { NewStudy } from "./new-study";
import { StudyHead } from "./study-head";
import { useStudy } from "./use-study";
import "./study.css";

/** View of a study, or of the form for a new one. */
export function StudyView({ id }: { id: string }) {
  return id === "new" ? <NewStudy /> : <OneStudy id={id} />;
}

function OneStudy({ id }: { id: string }) {
  const { value: seen, problem, again } = useStudy(id);
  useTitle(seen?.study.study.title || "Study");
  if (!seen) {
    return (
      <>
        <h1>Study</h1>
        {problem ? <ProblemNotice problem={problem} /> : <p class="quiet">Reading …</p>}
        <p>
          <Link href="/studies">All studies</Link>
        </p>
      </>
    );
  }
  const { study: state, answers, members } = seen;
  return (
    <div class="study">
      <StudyHead seen={seen} again={again} />
      {problem !== undefined && <ProblemNotice problem={problem} />}
      <EnlargeForm state={state} again={again} />
      <AnswersView seen={seen} />
      <LevelsTable answers={answers} accuracy={state.study.accuracy} />
      <InputsTable study={state.study} />
      <MembersTable
        state={state}
        coarsest={members}
        cellSizes={(answers.levels ?? []).map(({ cell_size_m }) => cell_size_m)}
      />
      <section aria-labelledby="files-title">
        <h2 id="files-title">Files</h2>
        <StudyFiles id={state.id} />
      </section>
      <details>
        <summary>The study's document</summary>
        <pre tabIndex={0}>{JSON.stringify(state.study, null, 2)}</pre>
      </details>
    </div>
  );
}
