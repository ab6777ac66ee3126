import { ServiceProblem } from "../api/problem";

/** Notice of what went wrong, read out by screen readers. */
export function ProblemNotice({ problem }: { problem: unknown }) {
  const is = problem instanceof ServiceProblem ? problem : undefined;
  return (
    <div class="notice problem" role="alert">
      <strong>{is?.document.title ?? "It did not work"}</strong>
      <p>{problem instanceof Error ? problem.message : String(problem)}</p>
      {is && is.violations.length > 0 && (
        <ul>
          {is.violations.map((violation) => (
            <li key={violation.pointer + violation.detail}>
              <code>{violation.pointer}</code> {violation.detail}
            </li>
          ))}
        </ul>
      )}
    </div>
  );
}
