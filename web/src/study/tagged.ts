import { request } from "../api/client";
import { ServiceProblem } from "../api/problem";

/** An answer that is asked for again and again, and sent only when it has changed. */
export class TaggedAnswer<T> {
  private tag: string | undefined;
  value: T | undefined;

  constructor(private readonly path: string) {}

  /** The answer as it is now: the same object as before if nothing has changed. */
  async read(signal: AbortSignal): Promise<T> {
    const known = this.tag !== undefined && this.value !== undefined;
    const headers: Record<string, string> = known ? { "If-None-Match": this.tag ?? "" } : {};
    try {
      const response = await request(this.path, { headers, signal });
      this.value = (await response.json()) as T;
      this.tag = response.headers.get("ETag") ?? undefined;
    } catch (problem) {
      const isUnchanged = problem instanceof ServiceProblem && problem.status === 304;
      if (!isUnchanged || this.value === undefined) throw problem;
    }
    return this.value;
  }
}
