import { type ComponentChildren, createContext } from "preact";
import { useContext } from "preact/hooks";
import { type Interface, type Schema, nameOfReference, schemaAnchor } from "./contract";
import { Part } from "./entry";
import { factsOf, kindOf } from "./schema-text";

/** The interface whose schemas refer to each other. */
export const InterfaceContext = createContext<Interface | undefined>(undefined);

/** Kind of a value, with links to the schemas it is made of. */
export function Kind({ schema }: { schema: Schema }): ComponentChildren {
  if (schema.$ref) {
    const name = nameOfReference(schema.$ref);
    return <a href={`#${schemaAnchor(name)}`}>{name}</a>;
  }
  const choices = schema.oneOf ?? schema.allOf;
  if (choices) {
    const word = schema.oneOf ? " or " : " with ";
    return choices.map((choice, place) => [place > 0 && word, <Kind key={place} schema={choice} />]);
  }
  const isList = [schema.type].flat().includes("array");
  if (isList && schema.items)
    return [
      "list of ",
      <Kind key="items" schema={schema.items} />,
      [schema.type].flat().includes("null") && " or null",
    ];
  return kindOf(schema);
}

/** A text of the contract, in which names stand between backticks. */
export function Prose({ text }: { text: string }) {
  return <>{text.split("`").map((piece, place) => (place % 2 === 1 ? <code key={place}>{piece}</code> : piece))}</>;
}

/** Facts about a value, and its description. */
export function Facts({ schema, description }: { schema: Schema; description?: string | undefined }) {
  const facts = factsOf(schema);
  const said = description ?? schema.description;
  return (
    <>
      {facts.length > 0 && <span class="facts">{facts.join("; ")}</span>}
      {said && (
        <p>
          <Prose text={said} />
        </p>
      )}
    </>
  );
}

/** Fields of a schema, each of which can be opened if it has fields itself. */
export function Fields({ schema }: { schema: Schema }) {
  const { schema: named } = useContext(InterfaceContext) ?? {};
  const resolved = schema.$ref ? named?.(schema.$ref) : schema;
  if (!resolved) return null;
  const parts = resolved.oneOf ?? resolved.allOf;
  if (parts) return <Choices parts={parts} isChoice={resolved.oneOf !== undefined} />;
  const { properties, required, items, additionalProperties } = resolved;
  if (items && !properties) return <Fields schema={items} />;
  if (!properties && typeof additionalProperties === "object")
    return (
      <ul class="fields">
        <Field name="any name" schema={additionalProperties} isRequired={false} />
      </ul>
    );
  if (!properties) return <Facts schema={resolved} description="" />;
  return (
    <ul class="fields">
      {Object.entries(properties).map(([name, property]) => (
        <Field key={name} name={name} schema={property} isRequired={required?.includes(name) ?? false} />
      ))}
    </ul>
  );
}

function Choices({ parts, isChoice }: { parts: Schema[]; isChoice: boolean }) {
  return (
    <>
      <p class="quiet">{isChoice ? "One of:" : "All of:"}</p>
      <ul class="choices">
        {parts.map((part, place) => (
          <li key={place}>
            <Kind schema={part} />
            <Facts schema={part} />
            {hasFields(part) &&
              (part.$ref ? (
                <Part summary="Its fields">{() => <Fields schema={part} />}</Part>
              ) : (
                <Fields schema={part} />
              ))}
          </li>
        ))}
      </ul>
    </>
  );
}

function Field({ name, schema, isRequired }: { name: string; schema: Schema; isRequired: boolean }) {
  return (
    <li>
      <code>{name}</code>{" "}
      <span class="kind">
        <Kind schema={schema} />
      </span>{" "}
      {isRequired && <span class="needed">required</span>} <Facts schema={schema} />
      {hasFields(schema) && <Part summary={<>Fields of {name}</>}>{() => <Fields schema={schema} />}</Part>}
    </li>
  );
}

/** True if a schema leads to fields, perhaps by a reference. */
function hasFields(schema: Schema): boolean {
  if (schema.$ref || schema.properties || typeof schema.additionalProperties === "object") return true;
  return [...(schema.oneOf ?? []), ...(schema.allOf ?? []), ...(schema.items ? [schema.items] : [])].some(hasFields);
}
