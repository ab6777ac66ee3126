import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import type { FieldError } from "../api/problem";
import { type JsonObject, at, differences, isObject, parentOf, prefixes, tokens } from "../parts/json-document";
import { groundOf } from "../scenario/ground";
import { sceneOf } from "../scenario/scene";
import { type Schemas, resolved, schemaAt } from "../scenario/schema";
import { type FormState, elementId } from "./form-context";
import { isEssential } from "./layout";
import { groupsOf } from "./sections";
import { useGround } from "./use-ground";

interface Given {
  /** Schemas of the contract. */
  schemas: Schemas;
  document: JsonObject;
  original: JsonObject;
  violations: FieldError[];
  replace: (document: JsonObject, edit: string) => void;
  /** Goes to a pointer in another way than to its field; false if the fields are shown. */
  revealElsewhere: (pointer: string) => boolean;
}

/** State that the fields share. */
export function useFormState(given: Given): FormState {
  const { document, original, violations, replace, revealElsewhere } = given;
  const ground = useGround(document, original, given.schemas);
  const { schemas } = ground;
  const [open, setOpenGroups] = useState<Record<string, boolean>>({});
  const [sought, setSought] = useState<{ pointer: string }>();
  const scene = useMemo(() => sceneOf(document, schemas), [document, schemas]);
  const differing = useMemo(() => differences(original, document), [original, document]);
  useEffect(() => {
    if (sought) focusField(sought.pointer);
  }, [sought]);
  // An edit is of the latest document, whichever was shown when its input was.
  const latest = useRef(document);
  latest.current = document;
  return {
    schemas,
    document,
    original,
    scene,
    violations,
    differences: differing,
    replace,
    edit: (pointer, value) => replace(ground.edited(latest.current, pointer, value), pointer),
    chooseGround: (chosen) => {
      if (chosen !== groundOf(latest.current)) replace(ground.putOn(latest.current, chosen), `ground ${chosen}`);
    },
    isOpen: (group) => open[group],
    setOpen: (group, isOpen) => setOpenGroups((open) => ({ ...open, [group]: isOpen })),
    reveal: (pointer) => {
      if (revealElsewhere(pointer)) return;
      const opened = groupsRound(pointer, document, schemas).map((group) => [group, true]);
      setOpenGroups((open) => ({ ...open, ...(Object.fromEntries(opened) as Record<string, boolean>) }));
      setSought({ pointer });
    },
  };
}

/** All groups round a field. */
function groupsRound(pointer: string, document: JsonObject, schemas: Schemas): string[] {
  const scenario = resolved({ $ref: "#/components/schemas/Scenario" }, schemas);
  const inner = prefixes(pointer).flatMap((prefix) => {
    const owner = parentOf(prefix);
    const isFolded = owner !== "" && !isEssential(tokens(prefix).at(-1) ?? "", schemaAt(owner, document, schemas));
    const isItem = Array.isArray(at(document, owner)) && isObject(at(document, prefix));
    return [...(isFolded ? [`${owner}#more`] : []), ...(isItem ? [prefix] : [])];
  });
  return [...groupsOf(pointer, scenario, schemas), ...inner];
}

/** Moves the focus to a field, or to what it is in. */
function focusField(pointer: string): void {
  for (let here = pointer; here !== ""; here = parentOf(here)) {
    const element = document.getElementById(elementId(here));
    if (!element) continue;
    element.scrollIntoView({ block: "center" });
    element.focus({ preventScroll: true });
    return;
  }
}
