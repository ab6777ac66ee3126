import { type Json, at, isObject, member } from "../parts/json-document";
import { type FieldSchema, type Schemas, kindOf, resolved } from "../scenario/schema";
import { AccuracyControl } from "./accuracy-control";
import { Field, Violations } from "./field";
import { elementId, useForm } from "./form-context";
import { Group } from "./group";
import { GroundChoice } from "./ground-choice";
import { CONTROLLED, arranged } from "./layout";
import { FieldGrid, ListField, ObjectFields, Presence } from "./parts-of-scenario";
import { labelOf } from "./words";

/** All fields of the scenario: one section for each object, and one for single fields. */
export function Sections() {
  const { schemas } = useForm();
  const scenario = resolved({ $ref: "#/components/schemas/Scenario" }, schemas);
  const { essential, rest } = arranged(scenario);
  const single = (key: string) => !hasSection(schemaOf(scenario, key, schemas), schemas);
  const sections = [...essential, ...rest].filter((key) => !single(key));
  return (
    <>
      <GroundChoice />
      {sections
        .filter((key) => essential.includes(key))
        .map((key) => (
          <Section key={key} name={key} scenario={scenario} isOpenAtFirst />
        ))}
      <Singles title="Time and title" keys={essential.filter(single)} scenario={scenario} isOpenAtFirst />
      {sections
        .filter((key) => rest.includes(key))
        .map((key) => (
          <Section key={key} name={key} scenario={scenario} isOpenAtFirst={false} />
        ))}
      <Singles title="More settings" keys={rest.filter(single)} scenario={scenario} isOpenAtFirst={false} />
    </>
  );
}

function schemaOf(scenario: FieldSchema, key: string, schemas: Schemas): FieldSchema {
  return resolved(scenario.properties?.[key] ?? {}, schemas);
}

function hasSection(schema: FieldSchema, schemas: Schemas): boolean {
  return ["object", "list", "variants"].includes(kindOf(schema, schemas));
}

interface SectionProps {
  name: string;
  scenario: FieldSchema;
  isOpenAtFirst: boolean;
}

function Section({ name, scenario, isOpenAtFirst }: SectionProps) {
  const { schemas, document } = useForm();
  const schema = schemaOf(scenario, name, schemas);
  const pointer = member("", name);
  const kind = kindOf(schema, schemas);
  const props = { pointer, schema, isRequired: scenario.required?.includes(name) ?? false };
  const value = at(document, pointer);
  return (
    <Group
      name={pointer}
      title={<h2>{sectionTitle(name, value)}</h2>}
      pointers={[pointer]}
      isOpenAtFirst={isOpenAtFirst}
      class="section"
    >
      {() => (
        <div id={kind === "list" || schema.isNullable ? undefined : elementId(pointer)} tabIndex={-1}>
          {kind === "list" && <ListField {...props} />}
          {kind === "variants" && <Field {...props} />}
          {kind === "object" && schema.isNullable && <Presence {...props} />}
          {kind === "object" && !schema.isNullable && <Violations pointer={pointer} />}
          {pointer in CONTROLLED && <AccuracyControl />}
          {kind === "object" && (!schema.isNullable || isObject(value)) && (
            <ObjectFields pointer={pointer} schema={schema} omitted={CONTROLLED[pointer] ?? []} />
          )}
        </div>
      )}
    </Group>
  );
}

function sectionTitle(name: string, value: Json | undefined): string {
  return Array.isArray(value) ? `${labelOf(name)} (${value.length})` : labelOf(name);
}

interface SinglesProps {
  title: string;
  keys: string[];
  scenario: FieldSchema;
  isOpenAtFirst: boolean;
}

function Singles({ title, keys, scenario, isOpenAtFirst }: SinglesProps) {
  if (keys.length === 0) return null;
  return (
    <Group
      name={`#${title}`}
      title={<h2>{title}</h2>}
      pointers={keys.map((key) => member("", key))}
      isOpenAtFirst={isOpenAtFirst}
      class="section"
    >
      {() => <FieldGrid pointer="" schema={scenario} keys={keys} />}
    </Group>
  );
}

/** Groups in which the field at a pointer is. */
export function groupsOf(pointer: string, scenario: FieldSchema, schemas: Schemas): string[] {
  const [key = ""] = pointer.split("/").slice(1);
  if (hasSection(schemaOf(scenario, key, schemas), schemas)) return [member("", key)];
  return [`#${arranged(scenario).essential.includes(key) ? "Time and title" : "More settings"}`];
}
