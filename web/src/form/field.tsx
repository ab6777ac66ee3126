import type { ComponentChildren } from "preact";
import { at, tokens } from "../parts/json-document";
import { type FieldSchema, type Kind, kindOf, unitOf } from "../scenario/schema";
import { elementId, useForm, violationsWithin } from "./form-context";
import { FlagInput, JsonInput, NamesInput, NumberInput, TextInput, VectorInput } from "./inputs";
import { MapInput } from "./map-input";
import { NamedListField, NullableField, ObjectField, VariantsField } from "./parts-of-scenario";
import { described, labelOf, rangeOf, valueText } from "./words";

/** A field's place, schema, and whether it must be given. */
export interface FieldProps {
  pointer: string;
  schema: FieldSchema;
  isRequired: boolean;
}

/** A field of the scenario, in the way of its kind. */
export function Field(props: FieldProps) {
  const { schemas } = useForm();
  const kind = kindOf(props.schema, schemas);
  if (kind === "object") return props.schema.isNullable ? <NullableField {...props} /> : <ObjectField {...props} />;
  if (kind === "variants") return <VariantsField {...props} />;
  if (kind === "list") return <NamedListField {...props} />;
  return <PlainField {...props} kind={kind} />;
}

/** Pattern of the names of maps. */
const MAP_NAME = "^[0-9a-f]{64}$";

/** Attributes that tie an input to its texts. */
export interface InputProps {
  id: string;
  "aria-describedby": string;
  "aria-invalid": boolean;
  "aria-required": boolean;
}

function PlainField({ pointer, schema, isRequired, kind }: FieldProps & { kind: Kind }) {
  const { document, violations } = useForm();
  const value = at(document, pointer);
  const input: InputProps = {
    id: elementId(pointer),
    "aria-describedby": `help:${pointer} wrong:${pointer}`,
    "aria-invalid": violationsWithin(violations, pointer).length > 0,
    "aria-required": isRequired,
  };
  const props = { pointer, schema, value, input, isRequired };
  const isMap = schema.pattern === MAP_NAME;
  if (kind === "flag") return <FlagField {...props} />;
  return (
    <FieldFrame
      pointer={pointer}
      schema={schema}
      isRequired={isRequired}
      isWide={kind === "vector" || kind === "json" || isMap}
      isGroup={kind === "vector"}
    >
      {kind === "number" && <NumberInput {...props} />}
      {kind === "text" && (isMap ? <MapInput {...props} /> : <TextInput {...props} />)}
      {kind === "names" && <NamesInput {...props} />}
      {kind === "vector" && <VectorInput {...props} />}
      {kind === "json" && <JsonInput {...props} />}
    </FieldFrame>
  );
}

/** An input's props. */
export interface PlainProps extends FieldProps {
  value: ReturnType<typeof at>;
  input: InputProps;
}

function FlagField(props: PlainProps) {
  return (
    <div class="field flag">
      <label>
        <FlagInput {...props} /> {labelOf(tokens(props.pointer).at(-1) ?? "")}
      </label>
      <FieldTexts {...props} />
    </div>
  );
}

interface FrameProps extends FieldProps {
  isWide?: boolean;
  /** True if several inputs share the label. */
  isGroup?: boolean;
  children: ComponentChildren;
}

/** Label, input, unit and texts of a field. */
export function FieldFrame({ isWide = false, isGroup = false, children, ...field }: FrameProps) {
  const { pointer, schema, isRequired } = field;
  const unit = unitOf(schema);
  const label = labelOf(tokens(pointer).at(-1) ?? "", unit);
  const name = (
    <>
      {label} {isRequired && <span class="required">required</span>}
    </>
  );
  return (
    <div class={isWide ? "field wide" : "field"} {...(isGroup && { role: "group", "aria-label": label })}>
      {isGroup ? <span class="label">{name}</span> : <label for={elementId(pointer)}>{name}</label>}
      <div class="input">
        {children}
        {unit !== undefined && <span class="unit">{unit}</span>}
      </div>
      <FieldTexts {...field} />
    </div>
  );
}

/** Help, former value and violations of a field. */
export function FieldTexts({ pointer, schema, isRequired }: FieldProps) {
  const { help, fallback } = described(schema);
  const range = rangeOf(schema.type === "array" ? (schema.items ?? {}) : schema);
  const shown =
    isRequired || fallback === undefined || schema.default !== undefined ? undefined : `Left empty: ${fallback}.`;
  return (
    <>
      <p class="help" id={`help:${pointer}`}>
        {[help, range !== undefined && `Range: ${range}.`, shown].filter(Boolean).join(" ")}
      </p>
      <Former pointer={pointer} unit={unitOf(schema)} />
      <Violations pointer={pointer} isDeep />
    </>
  );
}

/** Former value of a field that differs from the original's. */
export function Former({ pointer, unit }: { pointer: string; unit?: string | undefined }) {
  const { differences, edit } = useForm();
  const difference = differences.find((one) => one.pointer === pointer);
  if (!difference) return null;
  return (
    <p class="former">
      Was {valueText(difference.was, unit)}.{" "}
      <button type="button" class="link" onClick={() => edit(pointer, difference.was)}>
        Restore<span class="hidden"> {labelOf(tokens(pointer).at(-1) ?? "")}</span>
      </button>
    </p>
  );
}

/** Violations of a field; deep: also those within it. */
export function Violations({ pointer, isDeep = false }: { pointer: string; isDeep?: boolean }) {
  const { violations } = useForm();
  const own = isDeep ? violationsWithin(violations, pointer) : violations.filter((one) => one.pointer === pointer);
  return (
    <div id={`wrong:${pointer}`}>
      {own.map(({ detail }) => (
        <p class="violation" key={detail}>
          {detail}
        </p>
      ))}
    </div>
  );
}
