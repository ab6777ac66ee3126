import type { components } from "./contract";

export type ProblemDocument = components["schemas"]["Problem"];
export type FieldError = components["schemas"]["FieldError"];

/** Time after which a service that does not say when is asked again, and the least time [s]. */
const NO_ANSWER_S = 5;
const LEAST_PAUSE_S = 1;

/** An answer of the service that is no success, or the lack of an answer (status 0). */
export class ServiceProblem extends Error {
  readonly status: number;
  readonly document: Partial<ProblemDocument>;
  /** Seconds after which the service wants to be asked again, if it says so. */
  readonly retryAfterS: number | undefined;

  constructor(status: number, document: Partial<ProblemDocument>, retryAfterS?: number) {
    super(document.detail ?? document.title ?? `the service answered with status ${status}`);
    this.name = "ServiceProblem";
    this.status = status;
    this.document = document;
    this.retryAfterS = retryAfterS;
  }

  /** All violations of the scenario's rules, each with the JSON pointer of its field. */
  get violations(): FieldError[] {
    return (this.document.errors as FieldError[] | undefined) ?? [];
  }
}

/** True if the same request may still be answered otherwise, so that its key is kept. */
export function isPassing(problem: unknown): boolean {
  return (
    !(problem instanceof ServiceProblem) || [0, 401, 408, 409, 429].includes(problem.status) || problem.status >= 500
  );
}

/** Seconds after which a service that is busy or does not answer is asked again; undefined of any other problem. */
export function pauseAfter(problem: unknown): number | undefined {
  if (!(problem instanceof ServiceProblem) || ![0, 429, 502, 503, 504].includes(problem.status)) return undefined;
  return Math.max(LEAST_PAUSE_S, problem.retryAfterS ?? NO_ANSWER_S);
}

/** Problem of an answer that is no success. */
export async function problemOf(response: Response): Promise<ServiceProblem> {
  const text = await response.text();
  const seconds = Number(response.headers.get("Retry-After") ?? NaN);
  const retryAfterS = Number.isFinite(seconds) ? seconds : undefined;
  try {
    return new ServiceProblem(response.status, JSON.parse(text) as Partial<ProblemDocument>, retryAfterS);
  } catch {
    return new ServiceProblem(response.status, { detail: text.slice(0, 300) }, retryAfterS);
  }
}
