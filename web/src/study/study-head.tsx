import { useEffect, useRef, useState } from "preact/hooks";
import { useLocation } from "wouter-preact";
import { data, api } from "../api/client";
import { moment } from "../parts/format";
import { ProblemNotice } from "../parts/problem-notice";
import type { SeenStudy } from "./use-study";

/** Head of a study: title, state, progress of its members, and what can be done with it. */
export function StudyHead({ seen, again }: { seen: SeenStudy; again: () => void }) {
  const { study } = seen;
  return (
    <header>
      <h1>{study.title || "Untitled study"}</h1>
      <p>
        <span class={`status ${study.status}`} role="status">
          {study.status}
        </span>{" "}
        <span class="quiet">
          submitted {moment(study.created)}
          {study.finished && `, ended ${moment(study.finished)}`}
          {study.submitter && `, by ${study.submitter}`}
        </span>
      </p>
      {study.problem && (
        <div class="notice problem" role="alert">
          <strong>{study.problem.title}</strong>
          <p>{study.problem.detail}</p>
        </div>
      )}
      <MemberProgress seen={seen} />
      <Endings id={study.id} isRunning={study.status === "running"} again={again} />
    </header>
  );
}

function MemberProgress({ seen: { study, answers } }: { seen: SeenStudy }) {
  const { finished, failed, failures } = answers.members;
  const isRunning = study.status === "running";
  const ended = finished + failed;
  const going = Math.max(0, study.members_made - ended);
  return (
    <div class={isRunning ? "notice warning" : ""}>
      <p>
        {isRunning ? (
          <strong>
            So far: {ended} of {study.members} members.{" "}
          </strong>
        ) : (
          `${finished} of ${study.members} members finished, ${failed} failed`
        )}
        {isRunning &&
          `${finished} finished, ${failed} failed, ${going} run or wait, ${Math.max(0, study.members - study.members_made)} are not made yet`}
        .
      </p>
      {isRunning && <progress aria-label="Members that have ended" max={study.members} value={ended} />}
      {failures.length > 0 && (
        <ul>
          {failures.map(({ reason, members }) => (
            <li key={reason}>
              {members} failed: {reason}
            </li>
          ))}
        </ul>
      )}
    </div>
  );
}

function Endings({ id, isRunning, again }: { id: string; isRunning: boolean; again: () => void }) {
  const [, navigate] = useLocation();
  const [isAsking, setIsAsking] = useState(false);
  const yes = useRef<HTMLButtonElement>(null);
  useEffect(() => yes.current?.focus(), [isAsking]);
  const [problem, setProblem] = useState<unknown>();
  const end = async () => {
    setProblem(undefined);
    setIsAsking(false);
    try {
      const query = isRunning ? {} : { remove: "ended" as const };
      await data(api.DELETE("/v1/studies/{id}", { params: { path: { id }, query } }));
      if (isRunning) again();
      else navigate("/studies");
    } catch (error) {
      setProblem(error);
    }
  };
  return (
    <>
      <div class="actions">
        {isAsking ? (
          <>
            <span>
              {isRunning ? "Stop this study and its members?" : "Remove this study, its answers and its members' jobs?"}
            </span>
            <button type="button" class="primary" ref={yes} onClick={() => void end()}>
              {isRunning ? "Yes, dismiss it" : "Yes, remove it"}
            </button>
            <button type="button" onClick={() => setIsAsking(false)}>
              No
            </button>
          </>
        ) : (
          <button type="button" onClick={() => setIsAsking(true)}>
            {isRunning ? "Dismiss …" : "Remove …"}
          </button>
        )}
      </div>
      {problem !== undefined && <ProblemNotice problem={problem} />}
    </>
  );
}
