/** What all fields of the form share. */

import { createContext } from "preact";
import { useContext } from "preact/hooks";
import type { FieldError } from "../api/problem";
import type { Difference, Json, JsonObject } from "../parts/json-document";
import type { Ground } from "../scenario/ground";
import type { Scene } from "../scenario/scene";
import type { Schemas } from "../scenario/schema";

/** The scenario, what is wrong with it, and the means to change it. */
export interface FormState {
  /** Schemas of scenarios on the ground that the document has. */
  schemas: Schemas;
  document: JsonObject;
  /** What the form began with. */
  original: JsonObject;
  scene: Scene | undefined;
  violations: FieldError[];
  differences: Difference[];
  /** Sets a field, or takes it away. */
  edit: (pointer: string, value: Json | undefined) => void;
  /** Puts another document in the place of this one; edits of one name are one step back. */
  replace: (document: JsonObject, edit: string) => void;
  /** Puts the scenario on a ground; chosen again, that is as before. */
  chooseGround: (ground: Ground) => void;
  isOpen: (group: string) => boolean | undefined;
  setOpen: (group: string, isOpen: boolean) => void;
  /** Opens the groups of a field and moves the focus to it. */
  reveal: (pointer: string) => void;
}

/** Context of the form. */
export const FormContext = createContext<FormState | undefined>(undefined);

/** State of the form round a field. */
export function useForm(): FormState {
  const state = useContext(FormContext);
  if (!state) throw new Error("a field needs a form round it");
  return state;
}

/** Identifier of the element that takes the focus for the field at a pointer. */
export const elementId = (pointer: string): string => `field:${pointer}`;

/** Violations of a field and of what is in it. */
export function violationsWithin(violations: FieldError[], pointer: string): FieldError[] {
  return violations.filter(({ pointer: at }) => at === pointer || (at?.startsWith(`${pointer}/`) ?? false));
}
