import { useState } from "preact/hooks";
import { type Json, same } from "../parts/json-document";
import { readText, written } from "../parts/json-text";
import type { PlainProps } from "./field";
import { useForm } from "./form-context";
import { nameOf, placeholderOf } from "./words";

const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

/** Value of the text of a number's input. What is no number stays a text, which the service refuses
 * by name. */
export function valueOf(text: string): Json | undefined {
  const trimmed = text.trim().replace("−", "-");
  if (trimmed === "") return undefined;
  const value = Number(trimmed);
  return NUMBER.test(trimmed) && Number.isFinite(value) ? value : trimmed;
}

function textOf(value: Json | undefined): string {
  if (value === undefined || value === null) return "";
  return typeof value === "object" ? JSON.stringify(value) : String(value);
}

interface NumberBoxProps {
  value: Json | undefined;
  onValue: (value: Json | undefined) => void;
  [attribute: string]: unknown;
}

/** Input of a number that keeps what is typed, as `0.10`, while it means the value. */
function NumberBox({ value, onValue, ...attributes }: NumberBoxProps) {
  const [typed, setTyped] = useState(textOf(value));
  const isMeant = same(valueOf(typed), value === null ? undefined : value);
  return (
    <input
      {...attributes}
      type="text"
      inputMode="decimal"
      autocomplete="off"
      spellcheck={false}
      value={isMeant ? typed : textOf(value)}
      onInput={({ currentTarget }) => {
        setTyped(currentTarget.value);
        onValue(valueOf(currentTarget.value));
      }}
    />
  );
}

/** Input of one number. */
export function NumberInput({ pointer, schema, value, input, isRequired }: PlainProps) {
  const { edit } = useForm();
  return (
    <NumberBox
      {...input}
      value={value}
      placeholder={placeholderOf(schema, isRequired)}
      onValue={(value) => edit(pointer, value)}
    />
  );
}

/** Input of a line of text. */
export function TextInput({ pointer, schema, value, input }: PlainProps) {
  const { edit } = useForm();
  return (
    <input
      {...input}
      type="text"
      maxLength={schema.maxLength}
      value={textOf(value)}
      onInput={({ currentTarget }) => edit(pointer, currentTarget.value === "" ? undefined : currentTarget.value)}
    />
  );
}

/** Select of one of several names. */
export function NamesInput({ pointer, schema, value, input, isRequired }: PlainProps) {
  const { edit } = useForm();
  const names = (schema.enum ?? []).map(String);
  const isKnown = value === undefined || value === null || names.includes(String(value));
  const fallback =
    typeof schema.default === "string" ? `default: ${nameOf(schema.default)}` : isRequired ? "choose one" : "none";
  return (
    <select
      {...input}
      value={textOf(value)}
      onChange={({ currentTarget }) => edit(pointer, currentTarget.value === "" ? undefined : currentTarget.value)}
    >
      <option value="">{fallback}</option>
      {!isKnown && <option value={textOf(value)}>{textOf(value)}</option>}
      {names.map((name) => (
        <option key={name} value={name}>
          {nameOf(name)}
        </option>
      ))}
    </select>
  );
}

/** Check box of what is true or false. */
export function FlagInput({ pointer, schema, value, input }: PlainProps) {
  const { edit } = useForm();
  const fallback = schema.default === true;
  const { "aria-required": _, ...attributes } = input;
  return (
    <input
      {...attributes}
      type="checkbox"
      checked={typeof value === "boolean" ? value : fallback}
      onChange={({ currentTarget: { checked } }) => edit(pointer, checked === fallback ? undefined : checked)}
    />
  );
}

const AXES: Record<number, string[]> = { 2: ["x", "y"], 3: ["x", "y", "z"], 4: ["w", "x", "y", "z"] };

/** Inputs of a vector's components, side by side. */
export function VectorInput({ pointer, schema, value, input, isRequired }: PlainProps) {
  const { edit } = useForm();
  const size = schema.maxItems ?? 3;
  const axes = AXES[size] ?? Array.from({ length: size }, (_, index) => String(index + 1));
  const fallback = Array.isArray(schema.default) ? (schema.default as Json[]) : undefined;
  const given = Array.isArray(value) ? value : undefined;
  const setPart = (index: number, part: Json | undefined) => {
    const parts = axes.map((_, at) =>
      at === index ? (part ?? null) : (given?.[at] ?? (given ? null : (fallback?.[at] ?? null))),
    );
    edit(pointer, parts.every((part) => part === null) ? undefined : parts);
  };
  return (
    <div class="vector">
      {axes.map((axis, index) => (
        <label key={axis}>
          <span class="axis">{axis}</span>
          <NumberBox
            {...input}
            id={index === 0 ? input.id : `${input.id}/${index}`}
            value={given?.[index]}
            placeholder={fallback ? String(fallback[index]) : isRequired ? "" : "–"}
            onValue={(part) => setPart(index, part)}
          />
        </label>
      ))}
    </div>
  );
}

/** Text of a value that is too much for inputs, as JSON. */
export function JsonInput({ pointer, value, input }: PlainProps) {
  const { edit } = useForm();
  const [typed, setTyped] = useState<string>();
  const read = typed === undefined || typed.trim() === "" ? undefined : readText(typed);
  const isMeant = typed !== undefined && (read?.error !== undefined || same(read?.value, value));
  return (
    <div class="json">
      <textarea
        {...input}
        class="code"
        rows={5}
        spellcheck={false}
        placeholder="[ … ]"
        value={isMeant ? typed : value === undefined ? "" : written(value)}
        onInput={({ currentTarget: { value: text } }) => {
          setTyped(text);
          const { value, error } = text.trim() === "" ? { value: undefined, error: undefined } : readText(text);
          if (!error) edit(pointer, value);
        }}
      />
      <p class="help">Written as JSON: a list like this has too many numbers for single inputs.</p>
      {isMeant && read?.error && (
        <p class="violation" role="status">
          Line {read.error.line}, column {read.error.column}: {read.error.message}. The last correct value is kept.
        </p>
      )}
    </div>
  );
}
