import { useId } from "preact/hooks";
import { type Values, keyOf } from "./asking";
import type { Interface, Parameter, Schema } from "./contract";

/** Fields for the parameters of a request. */
export function ParameterFields({
  parameters,
  values,
  onChange,
  named,
}: {
  parameters: Parameter[];
  values: Values;
  onChange: (values: Values) => void;
  named: Interface["schema"];
}) {
  return (
    <div class="parameters">
      {parameters.map((parameter) => (
        <ParameterField
          key={keyOf(parameter)}
          parameter={parameter}
          schema={parameter.schema.$ref ? (named(parameter.schema.$ref) ?? parameter.schema) : parameter.schema}
          value={values[keyOf(parameter)] ?? ""}
          onInput={(value) => onChange({ ...values, [keyOf(parameter)]: value })}
        />
      ))}
    </div>
  );
}

interface FieldProps {
  parameter: Parameter;
  schema: Schema;
  value: string;
  onInput: (value: string) => void;
}

function ParameterField({ parameter: { name, in: place, required }, schema, value, onInput }: FieldProps) {
  const id = useId();
  const types = [schema.type].flat();
  const isNumber = types.includes("number") || types.includes("integer");
  const hint = types.includes("array")
    ? "separated by commas"
    : schema.default !== undefined
      ? `default ${JSON.stringify(schema.default)}`
      : "";
  return (
    <>
      <label for={id}>
        <code>{name}</code>{" "}
        <span class="quiet">
          {place}
          {required ? ", required" : ""}
        </span>
      </label>
      {schema.enum ? (
        <select id={id} value={value} onChange={(event) => onInput(event.currentTarget.value)}>
          <option value="">left out</option>
          {schema.enum.map((one) => (
            <option key={String(one)}>{String(one)}</option>
          ))}
        </select>
      ) : (
        <input
          id={id}
          value={value}
          required={required ?? false}
          placeholder={hint}
          inputMode={isNumber ? "decimal" : "text"}
          autocomplete="off"
          spellcheck={false}
          onInput={(event) => onInput(event.currentTarget.value)}
        />
      )}
    </>
  );
}
