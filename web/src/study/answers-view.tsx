import { useMemo } from "preact/hooks";
import { figure } from "../parts/format";
import type { AnswerProps } from "./answer-props";
import { type StudyAnswer, type StudyQuestion, isDraw } from "./documents";
import { AnswerFiles } from "./downloads";
import { ofBody } from "./names";
import { BuriedAnswer, ExceedsAnswer } from "./probability-answers";
import { RestAnswer } from "./rest-answer";
import { TornadoChart } from "./tornado-chart";
import type { SeenStudy } from "./use-study";
import { MeanAnswer, QuantilesAnswer } from "./value-answers";

/** Answers of a study, one for each question, marked as preliminary while it runs. */
export function AnswersView({ seen: { study: state, answers, members } }: { seen: SeenStudy }) {
  const { study } = state;
  const draws = useMemo(
    () => members.filter(({ member }) => isDraw(study.design, member, study.inputs.length)),
    [members, study],
  );
  const questions = study.questions ?? [];
  const shared: AnswerProps = { study, members, draws, hasLevels: (answers.levels ?? []).length > 0 };
  const soFar =
    state.status === "running"
      ? `So far: ${answers.members.finished + answers.members.failed} of ${state.members} members`
      : undefined;
  if (questions.length === 0) return <p>This study asks no questions; its members are below.</p>;
  return (
    <div class="answers">
      {questions.map((question, place) => {
        const answer = answers.answers[place];
        return (
          <section
            key={place}
            class={`card answer${"rest" in question || "sensitivity" in question ? " whole" : ""}`}
            aria-labelledby={`question-${place}`}
          >
            <h2 id={`question-${place}`}>{title(question)}</h2>
            {soFar && <p class="so-far">{soFar}. This is not the final answer.</p>}
            {answer ? (
              <OneAnswer question={question} answer={answer} {...shared} />
            ) : (
              <p class="quiet">No answer yet.</p>
            )}
            <AnswerFiles id={state.id} place={place} question={question} />
          </section>
        );
      })}
    </div>
  );
}

function title(question: StudyQuestion): string {
  if ("rest" in question) return `Where body ${question.rest.body} comes to rest`;
  if ("buried" in question)
    return `Is body ${question.buried.body} buried deeper than ${figure(question.buried.deeper_than_m)} m?`;
  if ("exceeds" in question)
    return `How likely a threshold is exceeded: ${ofBody(question.exceeds.quantity, question.exceeds.body)}`;
  if ("mean" in question) return `Mean: ${ofBody(question.mean.quantity, question.mean.body)}`;
  if ("quantiles" in question) return `Quantiles: ${ofBody(question.quantiles.quantity, question.quantiles.body)}`;
  return `What it depends on: ${ofBody(question.sensitivity.quantity, question.sensitivity.body)}`;
}

function OneAnswer({ question, answer, ...shared }: AnswerProps & { question: StudyQuestion; answer: StudyAnswer }) {
  if ("rest" in question && "rest" in answer)
    return <RestAnswer {...shared} body={question.rest.body} rest={answer.rest} />;
  if ("exceeds" in question && "exceeds" in answer)
    return <ExceedsAnswer {...shared} asked={question.exceeds} answer={answer.exceeds} />;
  if ("buried" in question && "buried" in answer) return <BuriedAnswer answer={answer.buried} />;
  if ("mean" in question && "mean" in answer)
    return <MeanAnswer quantity={question.mean.quantity} answer={answer.mean} />;
  if ("quantiles" in question && "quantiles" in answer)
    return <QuantilesAnswer asked={question.quantiles} answer={answer.quantiles} />;
  if ("sensitivity" in question && "sensitivity" in answer)
    return <TornadoChart {...shared} asked={question.sensitivity} measures={answer.sensitivity} />;
  // The questions were changed between two requests.
  return <p class="quiet">The answer is being read.</p>;
}
