import type { Schemas } from "../api/client";
import { type ListedMember, finished, reasonOfFailure } from "./documents";
import { TaggedAnswer } from "./tagged";

/** Members of one request. */
const PAGE = 250;

/** Most members that the page reads: more are in the files. */
export const MOST_MEMBERS = 5_000;

/** Members of a study on a level, read page by page; pages whose members have all ended are read once. */
export class MemberPages {
  private readonly pages: TaggedAnswer<Schemas["MemberPage"]>[] = [];
  private readonly path: string;
  private members: ListedMember[] = [];

  constructor(study: string, level: number) {
    this.path = `v1/studies/${encodeURIComponent(study)}/members?level=${level}&limit=${PAGE}`;
  }

  /** All members: the same list as before if nothing has changed. */
  async read(signal: AbortSignal): Promise<ListedMember[]> {
    const read: ListedMember[] = [];
    for (let place = 0; place * PAGE < MOST_MEMBERS; place += 1) {
      const page = (this.pages[place] ??= new TaggedAnswer(`${this.path}&from=${place * PAGE}`));
      const { members, next } = isFinal(page.value) ? page.value : await page.read(signal);
      read.push(...members);
      if (next === null) break;
    }
    const isSame = read.length === this.members.length && read.every((member, place) => member === this.members[place]);
    if (!isSame) this.members = read;
    return this.members;
  }
}

function isFinal(page: Schemas["MemberPage"] | undefined): page is Schemas["MemberPage"] {
  return page !== undefined && page.members.length === PAGE && page.next !== null && page.members.every(hasEnded);
}

function hasEnded(member: ListedMember): boolean {
  return finished(member) !== undefined || reasonOfFailure(member) !== undefined;
}
