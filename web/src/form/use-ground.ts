import { useMemo, useRef } from "preact/hooks";
import type { Json, JsonObject } from "../parts/json-document";
import { type Ground, groundOf } from "../scenario/ground";
import type { Schemas } from "../scenario/schema";
import { editedDocument } from "./editing";
import { hasOther, onGround, schemasOn, withoutOther } from "./ground";

/** The ground of a scenario that is being written. */
export interface WrittenGround {
  /** Schemas of scenarios on it. */
  schemas: Schemas;
  /** A document on it with this value. */
  edited: (document: JsonObject, pointer: string, value: Json | undefined) => JsonObject;
  /** A document put on a ground; on one that it was on before, as it was there. */
  putOn: (document: JsonObject, ground: Ground) => JsonObject;
}

/** Ground of a document, with a memory of the other. */
export function useGround(document: JsonObject, original: JsonObject, contract: Schemas): WrittenGround {
  const ground = groundOf(document);
  const schemas = useMemo(() => schemasOn(ground, contract), [ground, contract]);
  const latest = useRef<Partial<Record<Ground, JsonObject>>>({ [groundOf(original)]: original });
  latest.current[ground] = document;
  return {
    schemas,
    edited: (document, pointer, value) => {
      const next = editedDocument(document, pointer, value, schemas);
      // A value of before, which comes back, may be of the other ground.
      return hasOther(document, ground) ? next : withoutOther(next, ground, schemas);
    },
    putOn: (document, chosen) => onGround(document, chosen, latest.current[chosen], schemas),
  };
}
