/** List of jobs: read page by page, and kept up to date by the events of the service. */

import { type JobStatus, type JobSummary, type Progress, api, data } from "../api/client";
import { pauseAfter } from "../api/problem";
import type { ServiceEvent } from "../events/stream";
import { hasEnded } from "../parts/status";
import { Throttle } from "../parts/throttle";
import { type Filter, query } from "./filter";

/** Jobs of a page. */
const PAGE = 100;

/** Time between two looks at the newest jobs while events keep coming [ms]. */
const PAUSE_MS = 1_000;

/** What a view of the list shows. */
export interface ListState {
  jobs: JobSummary[];
  /** True if there are older jobs that have not been read. */
  hasMore: boolean;
  isReading: boolean;
  problem: unknown;
}

/** Jobs that meet a filter, newest first. */
export class JobList {
  state: ListState = { jobs: [], hasMore: false, isReading: true, problem: undefined };
  private cursor: string | null = null;
  private readonly looks = new Throttle(() => this.reading(() => this.look()), PAUSE_MS);
  private readonly lookIfSeen = () => {
    // Of many open pages one is seen: the others look once they are.
    if (!document.hidden && this.isStale) this.looks.ask();
  };
  private later: ReturnType<typeof setTimeout> | undefined;
  /** Requests in progress: a look at the newest jobs and one for older ones may be at the same time. */
  private readings = 0;
  private isStale = false;
  private isClosed = false;

  constructor(
    private readonly filter: Filter,
    private readonly tell: (state: ListState) => void,
  ) {
    document.addEventListener("visibilitychange", this.lookIfSeen);
    void this.readMore();
  }

  close(): void {
    this.isClosed = true;
    document.removeEventListener("visibilitychange", this.lookIfSeen);
    this.looks.end();
    clearTimeout(this.later);
  }

  /** Reads the next page of older jobs. */
  async readMore(): Promise<void> {
    await this.reading(async () => {
      const page = await this.page(this.cursor);
      this.cursor = page.next_cursor;
      this.set({ jobs: merged(this.state.jobs, page.jobs), hasMore: page.next_cursor !== null });
    });
  }

  /** Takes an event of the service. */
  take(event: ServiceEvent): void {
    switch (event.kind) {
      case "progress":
        this.change(event.id, (job) => withProgress(job, event.progress as Progress));
        return;
      case "removed":
        this.set({ jobs: this.state.jobs.filter((job) => job.id !== event.id) });
        return;
      case "status":
        this.change(event.id, (job) => withStatus(job, event.status as JobStatus));
        this.lookSoon();
        return;
      case "reset":
        this.lookSoon();
    }
  }

  private lookSoon(): void {
    this.isStale = true;
    this.lookIfSeen();
  }

  private change(id: string, change: (job: JobSummary) => JobSummary): void {
    const place = this.state.jobs.findIndex((job) => job.id === id);
    const job = this.state.jobs[place];
    if (job) this.set({ jobs: this.state.jobs.with(place, change(job)) });
  }

  /** Looks at the newest jobs. */
  private async look(): Promise<void> {
    this.isStale = false;
    const page = await this.page(null);
    const newest = new Set(page.jobs.map((job) => job.id));
    if (!this.state.jobs.some((job) => newest.has(job.id))) {
      // Between these and those that are known there may be others.
      this.cursor = page.next_cursor;
      this.set({ jobs: page.jobs, hasMore: page.next_cursor !== null });
      return;
    }
    const oldest = page.jobs.at(-1)?.created ?? "";
    const isOlder = (job: JobSummary) => page.next_cursor !== null && job.created <= oldest;
    // Of the part that was looked at, what is not there any more is removed or meets the filter no more.
    const kept = this.state.jobs.filter((job) => newest.has(job.id) || isOlder(job));
    this.set({ jobs: merged(kept, page.jobs) });
  }

  private async page(cursor: string | null) {
    const asked = { ...query(this.filter), limit: PAGE, ...(cursor === null ? {} : { cursor }) };
    return data(api.GET("/v1/jobs", { params: { query: asked } }));
  }

  private async reading(read: () => Promise<void>): Promise<void> {
    this.readings += 1;
    this.set({ isReading: true });
    try {
      await read();
      this.ended(undefined);
    } catch (problem) {
      this.ended(problem);
      const pauseS = pauseAfter(problem);
      clearTimeout(this.later);
      if (pauseS !== undefined && !this.isClosed) this.later = setTimeout(() => this.lookSoon(), 1_000 * pauseS);
    }
  }

  private ended(problem: unknown): void {
    this.readings -= 1;
    this.set({ isReading: this.readings > 0, problem });
  }

  private set(change: Partial<ListState>): void {
    if (this.isClosed) return;
    this.state = { ...this.state, ...change };
    this.tell(this.state);
  }
}

/** Both lists, newest first; of a job in both the second one's. */
export function merged(known: JobSummary[], read: JobSummary[]): JobSummary[] {
  const jobs = new Map(known.map((job) => [job.id, job]));
  for (const job of read) jobs.set(job.id, job);
  // Times have the same length everywhere, and of two identifiers the later one is greater.
  const key = (job: JobSummary) => job.created + job.id;
  return [...jobs.values()].sort((a, b) => (key(a) < key(b) ? 1 : -1));
}

/** Job with its progress, which may come later than its end. */
export function withProgress(job: JobSummary, progress: Progress): JobSummary {
  return hasEnded(job.status) ? job : { ...job, progress };
}

function withStatus(job: JobSummary, status: JobStatus): JobSummary {
  // An older event than what is known, after the stream was opened again.
  if (hasEnded(job.status)) return job;
  return { ...job, status, finished: hasEnded(status) ? new Date().toISOString() : job.finished };
}
