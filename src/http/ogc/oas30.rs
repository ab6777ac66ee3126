//! Schemas of the contract (OpenAPI 3.1) as a process description has them: in OpenAPI 3.0, and
//! without references.

use serde_json::{Map, Value};

/// Members of a schema that are one schema or a list of them.
const NESTED: [&str; 5] = ["items", "oneOf", "anyOf", "allOf", "additionalProperties"];

/// The component of this name, with all that it refers to, in OpenAPI 3.0.
pub(super) fn component(components: &Value, name: &str) -> Value {
    resolved(components, &components[name])
}

fn resolved(components: &Value, schema: &Value) -> Value {
    match schema {
        Value::Object(members) => object(components, members).into(),
        Value::Array(schemas) => {
            let all = schemas.iter().map(|schema| resolved(components, schema));
            Value::Array(all.collect())
        }
        other => other.clone(),
    }
}

fn object(components: &Value, members: &Map<String, Value>) -> Map<String, Value> {
    let mut schema = with_target(components, members);
    for key in NESTED {
        if let Some(nested) = schema.get_mut(key) {
            *nested = resolved(components, nested);
        }
    }
    if let Some(Value::Object(properties)) = schema.get_mut("properties") {
        for property in properties.values_mut() {
            *property = resolved(components, property);
        }
    }
    let is_nullable = take_null(&mut schema);
    let mut schema = only_alternative(schema);
    if is_nullable {
        schema.insert("nullable".to_owned(), Value::Bool(true));
    }
    for (bound, exclusive) in [
        ("minimum", "exclusiveMinimum"),
        ("maximum", "exclusiveMaximum"),
    ] {
        if let Some(value) = schema.remove(exclusive) {
            schema.insert(bound.to_owned(), value);
            schema.insert(exclusive.to_owned(), Value::Bool(true));
        }
    }
    if let Some(Value::Array(examples)) = schema.remove("examples") {
        let example = examples.into_iter().next();
        schema.extend(example.map(|example| ("example".to_owned(), example)));
    }
    schema
}

/// The members of a schema and of the one it refers to; its own win.
fn with_target(components: &Value, members: &Map<String, Value>) -> Map<String, Value> {
    let Some(name) = members.get("$ref").and_then(Value::as_str) else {
        return members.clone();
    };
    let target = &components[name.rsplit('/').next().unwrap_or_default()];
    let mut merged = target.as_object().cloned().unwrap_or_default();
    merged.extend(members.clone());
    merged.remove("$ref");
    merged
}

/// Takes null out of the types or alternatives of a schema; true if it was one of them.
fn take_null(schema: &mut Map<String, Value>) -> bool {
    let mut had_null = false;
    if let Some(Value::Array(types)) = schema.get_mut("type") {
        types.retain(|kind| kind != "null");
        // A schema of the contract has one type beside null.
        let only = types.pop();
        schema.extend(only.map(|only| ("type".to_owned(), only)));
        had_null = true;
    }
    if let Some(Value::Array(alternatives)) = schema.get_mut("oneOf") {
        let all = alternatives.len();
        alternatives.retain(|alternative| alternative["type"] != "null");
        had_null |= alternatives.len() < all;
    }
    had_null
}

/// A schema with one alternative left, as that alternative.
fn only_alternative(mut schema: Map<String, Value>) -> Map<String, Value> {
    if !matches!(schema.get("oneOf"), Some(Value::Array(all)) if all.len() == 1) {
        return schema;
    }
    if let Some(Value::Array(mut all)) = schema.remove("oneOf")
        && let Some(Value::Object(only)) = all.pop()
    {
        schema.extend(only);
    }
    schema
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn what_only_the_newer_version_has_is_said_in_the_older() {
        let components = json!({
            "Whole": {"type": "object", "properties": {
                "ref": {"$ref": "#/components/schemas/Part", "description": "own"},
                "maybe": {"oneOf": [{"$ref": "#/components/schemas/Part"}, {"type": "null"}]},
                "number": {"type": ["number", "null"], "exclusiveMinimum": 0},
                "list": {"type": "array", "items": {"$ref": "#/components/schemas/Part"}},
            }, "examples": [{"a": 1}, {"a": 2}]},
            "Part": {"type": "string", "description": "a part"},
        });
        let part = json!({"type": "string", "description": "a part"});
        let wanted = json!({"type": "object", "properties": {
            "ref": {"type": "string", "description": "own"},
            "maybe": {"type": "string", "description": "a part", "nullable": true},
            "number": {"type": "number", "nullable": true, "minimum": 0, "exclusiveMinimum": true},
            "list": {"type": "array", "items": part},
        }, "example": {"a": 1}});
        assert_eq!(component(&components, "Whole"), wanted);
    }
}
