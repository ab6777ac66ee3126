/** Members of a study as the rows of a table: their columns, and their order. */

import { unitOfKey } from "../parts/words";
import type { ListedMember, Study } from "./documents";
import { quantityOf, reasonOfFailure } from "./documents";
import { lastKey, nameOf, placeName, titled } from "./names";

/** A column of the table. */
export interface Column {
  key: string;
  title: string;
  isNumber: boolean;
  /** Value of a member: shown, and sorted by. */
  of: (member: ListedMember) => number | string | undefined;
}

/** Order of the rows. */
export interface Order {
  column: string;
  isDescending: boolean;
}

/** Columns of a study: number, state, inputs, and the quantities that its questions are about. */
export function columns(study: Study): Column[] {
  const inputs = study.inputs.map(({ pointer }, input) => ({
    key: `input ${input}`,
    title: titled(placeName(pointer), unitOfKey(lastKey(pointer))),
    isNumber: true,
    of: (member: ListedMember) => shown(member.values[input]),
  }));
  const quantities = asked(study).map(([quantity, body]) => ({
    key: `${quantity} ${body}`,
    title: titled(body === undefined ? nameOf(quantity) : `body ${body}: ${nameOf(quantity)}`, unitOfKey(quantity)),
    isNumber: true,
    of: (member: ListedMember) => quantityOf(member, quantity, body),
  }));
  return [
    { key: "member", title: "Member", isNumber: true, of: ({ member }) => member },
    {
      key: "status",
      title: "State",
      isNumber: false,
      of: (member) => reasonOfFailure(member) ?? member.status ?? "waits",
    },
    ...inputs,
    ...quantities,
  ];
}

function shown(value: unknown): number | string | undefined {
  if (typeof value === "number" || value === undefined) return value;
  return typeof value === "string" ? value : JSON.stringify(value);
}

/** Quantities that questions are about, each once; the resting place for the map. */
function asked(study: Study): [quantity: string, body: number | undefined][] {
  const found = new Map<string, [string, number | undefined]>();
  const add = (quantity: string, body: number | null | undefined) =>
    found.set(`${quantity} ${body ?? ""}`, [quantity, body ?? undefined]);
  for (const question of study.questions ?? []) {
    if ("rest" in question) for (const name of ["rest_x_m", "rest_y_m"]) add(name, question.rest.body);
    else if ("buried" in question) add("buried_m", question.buried.body);
    else
      for (const { quantity, body } of Object.values(question) as { quantity: string; body?: number | null }[])
        add(quantity, body);
  }
  return [...found.values()];
}

/** Members in order; those without a value come last in either direction. */
export function sorted(members: ListedMember[], column: Column, isDescending: boolean): ListedMember[] {
  const keyed = members.map((member) => ({ member, value: column.of(member) }));
  const sign = isDescending ? -1 : 1;
  keyed.sort((a, b) => {
    if (a.value === undefined || b.value === undefined)
      return Number(a.value === undefined) - Number(b.value === undefined);
    return sign * compared(a.value, b.value) || a.member.member - b.member.member;
  });
  return keyed.map(({ member }) => member);
}

function compared(a: number | string, b: number | string): number {
  if (typeof a === "number" && typeof b === "number") return a - b;
  return String(a).localeCompare(String(b));
}
