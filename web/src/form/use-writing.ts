import { useState } from "preact/hooks";
import { type JsonObject, isObject } from "../parts/json-document";
import { readText } from "../parts/json-text";
import type { Draft } from "./draft";
import { type History, begin as beginHistory, edited, redone, undone } from "./history";

/** A scenario that is being written, by its fields or as text. */
export interface Writing {
  history: History;
  document: JsonObject;
  /** What it began with. */
  origin: Omit<Draft, "document">;
  text: WrittenText;
  /** Puts another document in the place of this one; edits of one name are one step back. */
  replace: (document: JsonObject, edit: string) => void;
  undo: () => void;
  redo: () => void;
  startOver: () => void;
  readFile: (file: File) => Promise<void>;
}

/** The text of a scenario. */
interface WrittenText {
  isShown: boolean;
  show: (isShown: boolean) => void;
  /** Text that is no scenario. */
  broken: string | undefined;
  setBroken: (text: string | undefined) => void;
  /** Count of the texts that come from elsewhere than their editor, which begins anew with each. */
  opened: number;
}

/** A scenario that begins with a draft. */
export function useWriting(begin: Draft): Writing {
  const [history, setHistory] = useState(() => beginHistory(begin.document));
  const [origin, setOrigin] = useState<Omit<Draft, "document">>(begin);
  const [isShown, show] = useState(false);
  const [broken, setBroken] = useState<string>();
  const [opened, setOpened] = useState(0);
  const replace = (document: JsonObject, edit: string) =>
    setHistory((history) => edited(history, document, edit, Date.now()));
  const open = (text: string | undefined) => {
    setBroken(text);
    setOpened((opened) => opened + 1);
  };
  const readFile = async (file: File) => {
    const text = await textOf(file);
    const { value } = readText(text);
    if (isObject(value)) {
      replace(value, "");
      setOrigin({ original: value, from: file.name, isOfFile: true });
    } else show(true);
    open(isObject(value) ? undefined : text);
  };
  return {
    history,
    document: history.present,
    origin,
    text: { isShown, show, broken, setBroken, opened },
    replace,
    undo: () => setHistory(undone),
    redo: () => setHistory(redone),
    startOver: () => {
      replace(origin.original, "");
      open(undefined);
    },
    readFile,
  };
}

/** Text of a file; empty if it cannot be read, which the editor says. */
async function textOf(file: File): Promise<string> {
  try {
    return await file.text();
  } catch {
    return "";
  }
}
