/** JSON text with the place of each value, and the line and column of what is wrong with it. */

import { type Json, type JsonObject, member } from "./json-document";

/** First error of a text. Lines and columns count from 1. */
export interface TextError {
  line: number;
  column: number;
  offset: number;
  message: string;
}

/** What a text holds: its value and the place of each part, or its first error. */
export interface ReadText {
  value?: Json;
  error?: TextError;
  /** Start and end of the value at each JSON pointer. */
  places: Map<string, [number, number]>;
}

const NUMBER = /-?(?:0|[1-9]\d*)(?:\.\d+)?(?:[eE][+-]?\d+)?/y;
const TEXT = /"(?:[^"\\\u0000-\u001f]|\\(?:["\\/bfnrt]|u[\da-fA-F]{4}))*"/y;
const SPACE = /[ \t\r\n]*/y;
const WORD = /[\w.+-]+|./suy;

/** Deepest nesting that is read, as of the service. */
const DEEPEST = 100;

/** Reads a JSON text. */
export function readText(text: string): ReadText {
  const reader = new Reader(text);
  try {
    return { value: reader.document(), places: reader.places };
  } catch (error) {
    if (!(error instanceof Failure)) throw error;
    return { error: locate(text, error), places: reader.places };
  }
}

class Failure extends Error {
  constructor(
    readonly offset: number,
    message: string,
  ) {
    super(message);
  }
}

function locate(text: string, { offset, message }: Failure): TextError {
  const before = text.slice(0, offset).split("\n");
  return { line: before.length, column: (before.at(-1) ?? "").length + 1, offset, message };
}

class Reader {
  readonly places = new Map<string, [number, number]>();
  private offset = 0;
  private depth = 0;

  constructor(private readonly text: string) {}

  document(): Json {
    const value = this.value("");
    if (this.offset < this.text.length) throw this.unexpected("the end of the text");
    return value;
  }

  /** Value with the space round it. */
  private value(pointer: string): Json {
    this.match(SPACE);
    const start = this.offset;
    const value = this.bare(pointer);
    this.places.set(pointer, [start, this.offset]);
    this.match(SPACE);
    return value;
  }

  private bare(pointer: string): Json {
    const first = this.text[this.offset];
    if (first === "{") return this.nested(() => this.object(pointer));
    if (first === "[") return this.nested(() => this.list(pointer));
    if (first === '"') return this.string();
    for (const word of ["true", "false", "null"]) {
      if (this.text.startsWith(word, this.offset) && this.word() === word) {
        this.offset += word.length;
        return JSON.parse(word) as Json;
      }
    }
    const start = this.offset;
    const digits = this.match(NUMBER);
    if (digits !== undefined && !/[\w.]/.test(this.text[this.offset] ?? "")) return Number(digits);
    this.offset = start;
    throw this.unexpected("a value");
  }

  private nested<T>(read: () => T): T {
    this.depth += 1;
    if (this.depth > DEEPEST) throw new Failure(this.offset, "this is nested too deep");
    this.offset += 1;
    this.match(SPACE);
    const value = read();
    this.depth -= 1;
    return value;
  }

  private object(pointer: string): JsonObject {
    const members = new Map<string, Json>();
    while (!this.takes("}")) {
      if (members.size > 0) this.expect(",", "a comma or the end of the object, }");
      this.match(SPACE);
      const start = this.offset;
      if (this.text[start] !== '"') throw this.unexpected("a key in quotation marks");
      const key = this.string();
      if (members.has(key)) throw new Failure(start, `"${key}" is there twice`);
      this.match(SPACE);
      this.expect(":", "a colon after the key");
      members.set(key, this.value(member(pointer, key)));
    }
    return Object.fromEntries(members);
  }

  private list(pointer: string): Json[] {
    const items: Json[] = [];
    while (!this.takes("]")) {
      if (items.length > 0) this.expect(",", "a comma or the end of the list, ]");
      items.push(this.value(member(pointer, items.length)));
    }
    return items;
  }

  private string(): string {
    const found = this.match(TEXT);
    if (found === undefined) throw new Failure(this.offset, "this text has no end in its line, or a wrong escape");
    return JSON.parse(found) as string;
  }

  private takes(sign: string): boolean {
    if (this.text[this.offset] !== sign) return false;
    this.offset += 1;
    return true;
  }

  private expect(sign: string, what: string): void {
    if (!this.takes(sign)) throw this.unexpected(what);
  }

  private match(pattern: RegExp): string | undefined {
    pattern.lastIndex = this.offset;
    const found = pattern.exec(this.text)?.[0];
    this.offset += found?.length ?? 0;
    return found;
  }

  private word(): string {
    WORD.lastIndex = this.offset;
    return WORD.exec(this.text)?.[0] ?? "";
  }

  private unexpected(expected: string): Failure {
    const found = this.word();
    return new Failure(this.offset, `expected ${expected}, found ${found === "" ? "the end of the text" : found}`);
  }
}

/** JSON as people write it: lists of numbers in one line. */
export function written(value: Json, indent = ""): string {
  const inner = `${indent}  `;
  if (Array.isArray(value)) {
    if (value.every((item) => typeof item !== "object" || item === null))
      return `[${value.map((item) => JSON.stringify(item)).join(", ")}]`;
    return `[\n${value.map((item) => inner + written(item, inner)).join(",\n")}\n${indent}]`;
  }
  if (typeof value !== "object" || value === null) return JSON.stringify(value);
  const members = Object.entries(value);
  if (members.length === 0) return "{}";
  return `{\n${members.map(([key, item]) => `${inner}${JSON.stringify(key)}: ${written(item, inner)}`).join(",\n")}\n${indent}}`;
}
