import { useRef } from "preact/hooks";
import { type Json, at, isObject, member, tokens } from "../parts/json-document";
import { type FieldSchema, type Variant, resolved, unitOf, variantOf, variantsOf } from "../scenario/schema";
import { solidOf } from "../scenario/solid";
import { shapeOf, withItem, withoutItem } from "./editing";
import { Field, FieldFrame, type FieldProps, Former, Violations } from "./field";
import { elementId, useForm } from "./form-context";
import { Group } from "./group";
import { arranged } from "./layout";
import { described, labelOf, objectName } from "./words";

/** Fields of an object, the less common ones folded. */
export function ObjectFields({
  pointer,
  schema,
  omitted = [],
}: {
  pointer: string;
  schema: FieldSchema;
  omitted?: string[];
}) {
  const { essential, rest } = arranged(schema, omitted);
  return (
    <>
      <FieldGrid pointer={pointer} schema={schema} keys={essential} />
      {rest.length > 0 && (
        <Group
          name={`${pointer}#more`}
          title={<MoreTitle keys={rest} schema={schema} />}
          pointers={rest.map((key) => member(pointer, key))}
          class="more"
        >
          {() => <FieldGrid pointer={pointer} schema={schema} keys={rest} />}
        </Group>
      )}
    </>
  );
}

/** Title of folded fields: the first of their names. */
function MoreTitle({ keys, schema }: { keys: string[]; schema: FieldSchema }) {
  const names = keys.map((key) => labelOf(key, unitOf(schema.properties?.[key] ?? {})).toLowerCase());
  const others = names.length - 3;
  return (
    <>
      More: {names.slice(0, 3).join(", ")}
      {others > 0 && ` and ${others} more`}
    </>
  );
}

/** Fields with these keys of an object, side by side where there is room. */
export function FieldGrid({ pointer, schema, keys }: { pointer: string; schema: FieldSchema; keys: string[] }) {
  const { schemas } = useForm();
  return (
    <div class="fields">
      {keys.map((key) => (
        <Field
          key={key}
          pointer={member(pointer, key)}
          schema={resolved(schema.properties?.[key] ?? {}, schemas)}
          isRequired={schema.required?.includes(key) ?? false}
        />
      ))}
    </div>
  );
}

/** An object within another. */
export function ObjectField({ pointer, schema }: FieldProps) {
  return (
    <fieldset class="wide" id={elementId(pointer)} tabIndex={-1}>
      <legend>{labelOf(tokens(pointer).at(-1) ?? "")}</legend>
      <Violations pointer={pointer} />
      <ObjectFields pointer={pointer} schema={schema} />
    </fieldset>
  );
}

/** An object that may be there or not, as the flow. */
export function NullableField(props: FieldProps) {
  const { pointer, schema } = props;
  const { document } = useForm();
  const label = labelOf(tokens(pointer).at(-1) ?? "");
  return (
    <fieldset class="wide">
      <legend>{label}</legend>
      <Presence {...props} />
      {isObject(at(document, pointer)) && <ObjectFields pointer={pointer} schema={schema} />}
    </fieldset>
  );
}

/** Check box of an object that may be there or not; unchecked and checked again it is as before. */
export function Presence({ pointer, isRequired }: FieldProps) {
  const { document, original, edit } = useForm();
  const value = at(document, pointer);
  const before = useRef<Json | undefined>(at(original, pointer));
  if (isObject(value)) before.current = value;
  return (
    <div class="presence">
      <label>
        <input
          id={elementId(pointer)}
          type="checkbox"
          checked={isObject(value)}
          onChange={({ currentTarget: { checked } }) =>
            edit(pointer, checked ? (isObject(before.current) ? before.current : {}) : isRequired ? null : undefined)
          }
        />{" "}
        There is a {labelOf(tokens(pointer).at(-1) ?? "").toLowerCase()}
      </label>
      <Former pointer={pointer} />
      <Violations pointer={pointer} />
    </div>
  );
}

/** A field that takes one of several forms. */
export function VariantsField(props: FieldProps) {
  const { pointer, schema, isRequired } = props;
  const { schemas, document, edit } = useForm();
  const value = at(document, pointer);
  const variants = variantsOf(schema, schemas);
  const index = variantOf(variants, value);
  const chosen = variants[index];
  const choose = (index: number) => edit(pointer, startOf(variants[index], value));
  return (
    <div class="variants wide">
      <FieldFrame {...props}>
        <select
          id={elementId(pointer)}
          value={String(index)}
          onChange={({ currentTarget }) => choose(Number(currentTarget.value))}
          aria-describedby={`help:${pointer} wrong:${pointer}`}
        >
          {(index < 0 || !isRequired) && <option value="-1">{isRequired ? "choose one" : "none"}</option>}
          {variants.map((variant, index) => (
            <option key={index} value={String(index)}>
              {variantName(variant)}
            </option>
          ))}
        </select>
      </FieldFrame>
      {chosen && (
        <div class="variant">
          <VariantFields pointer={pointer} variant={chosen} />
        </div>
      )}
    </div>
  );
}

/** Value that begins a form. One without a key of its own begins with what it requires. */
function startOf(variant: Variant | undefined, before: Json | undefined): Json | undefined {
  if (!variant) return undefined;
  if (variant.key !== undefined) return shapeOf(variant.key, before);
  return Object.fromEntries((variant.schema.required ?? []).map((key) => [key, [0]]));
}

function variantName({ key, schema }: Variant): string {
  return key !== undefined ? labelOf(key) : (described(schema).help.split(/[.:]/)[0] ?? "");
}

function VariantFields({ pointer, variant: { key, schema } }: { pointer: string; variant: Variant }) {
  const { schemas } = useForm();
  if (key === undefined) return <ObjectFields pointer={pointer} schema={schema} />;
  const inner = resolved(schema.properties?.[key] ?? {}, schemas);
  return <ObjectFields pointer={member(pointer, key)} schema={inner} />;
}

/** A list of objects within another, as the releases. */
export function NamedListField(props: FieldProps) {
  return (
    <fieldset class="wide">
      <legend>
        {labelOf(tokens(props.pointer).at(-1) ?? "")} {props.isRequired && <span class="required">required</span>}
      </legend>
      <ListField {...props} />
    </fieldset>
  );
}

/** A list of objects, as the bodies. */
export function ListField({ pointer, schema }: FieldProps) {
  const { schemas, document, scene, edit, setOpen } = useForm();
  const value = at(document, pointer);
  const list = Array.isArray(value) ? value : [];
  const items = resolved(schema.items ?? {}, schemas);
  const name = objectName(items.name ?? "Item");
  const isFull = list.length >= (schema.maxItems ?? Infinity);
  const add = (copied?: number) => {
    edit(pointer, withItem(list, copied, items.name ?? "", scene));
    setOpen(member(pointer, copied === undefined ? list.length : copied + 1), true);
    // What is open of a short list stays open when it is no longer short.
    if (list.length <= FEW) for (let index = 0; index < list.length; index += 1) setOpen(member(pointer, index), true);
  };
  return (
    <div class="list wide" id={elementId(pointer)} tabIndex={-1}>
      <Violations pointer={pointer} />
      {list.length === 0 && <p class="quiet">There are none yet.</p>}
      <div class={list.length > LONG ? "items long" : "items"}>
        {list.map((item, index) => (
          <Item
            key={index}
            pointer={member(pointer, index)}
            title={`${name} ${index}`}
            item={item}
            schema={items}
            isOpenAtFirst={list.length <= FEW}
            isFull={isFull}
            onCopy={() => add(index)}
            onRemove={() => edit(pointer, withoutItem(list, index))}
          />
        ))}
      </div>
      <div class="actions">
        <button type="button" disabled={isFull} onClick={() => add()}>
          Add a {name.toLowerCase()}
        </button>
        <span class="quiet">
          {list.length} of at most {schema.maxItems ?? "any number"}
        </span>
      </div>
    </div>
  );
}

/** Number of items that are open at first. */
const FEW = 2;

/** Number of items above which a list scrolls by itself. */
const LONG = 12;

interface ItemProps {
  pointer: string;
  title: string;
  item: Json;
  schema: FieldSchema;
  isOpenAtFirst: boolean;
  isFull: boolean;
  onCopy: () => void;
  onRemove: () => void;
}

function Item({ pointer, title, item, schema, isOpenAtFirst, isFull, onCopy, onRemove }: ItemProps) {
  const text = solidOf(at(item, "/shape"), at(item, "/sphero_radius_m"))?.text;
  const heading = (
    <>
      <strong>{title}</strong> {text !== undefined && <span class="quiet">{text}</span>}
      {at(item, "/fixed") === true && <span class="quiet"> fixed</span>}
    </>
  );
  return (
    <Group name={pointer} title={heading} pointers={[pointer]} isOpenAtFirst={isOpenAtFirst} class="item">
      {() => (
        <div id={elementId(pointer)} tabIndex={-1}>
          <Violations pointer={pointer} />
          <Former pointer={pointer} />
          <ObjectFields pointer={pointer} schema={schema} />
          <div class="actions">
            <button type="button" disabled={isFull} onClick={onCopy}>
              Duplicate<span class="hidden"> {title}</span>
            </button>
            <button type="button" onClick={onRemove}>
              Remove<span class="hidden"> {title}</span>
            </button>
          </div>
        </div>
      )}
    </Group>
  );
}
