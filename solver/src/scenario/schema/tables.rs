//! The tables of `docs/scenario.md`, from the table of fields and the schemas.

use super::{Schemas, default, without_default};
use crate::scenario::fields::{Default, Field, GroundKind, Kind, SECTIONS, Section};
use crate::scenario::range::short;
use crate::scenario::shape::{REGULAR_SOLIDS, SHAPES};
use crate::scenario::{FieldValue, ShapeField};
use serde_json::Value;
use utoipa::openapi::{RefOr, Schema};

/// Starts of the names in each table; the first holds the scenario's own fields alone.
const TABLES: [&str; 8] = [
    "",
    "channel.",
    "terrain.",
    "flow.",
    "flow.releases[].",
    "bodies[].",
    "numerics.",
    "accuracy.",
];

/// Rows of each table: field, meaning, unit, default and allowed values, in Markdown.
pub fn tables(schemas: &Schemas) -> Vec<Vec<String>> {
    TABLES.map(|path| rows(schemas, path)).to_vec()
}

/// Rows of a struct's fields, each followed by those of the struct it holds.
fn rows(schemas: &Schemas, path: &str) -> Vec<String> {
    let mut found = Vec::new();
    for section in SECTIONS.iter().filter(|section| section.path == path) {
        for field in section.fields {
            found.push(row(schemas, section, field));
            match field.kind {
                Kind::Shape => found.extend(of_shapes(&format!("{path}{}", field.key))),
                _ if path.is_empty() => {}
                _ => found.extend(rows(schemas, &format!("{path}{}.", field.key))),
            }
        }
    }
    found
}

fn row(schemas: &Schemas, section: &Section, field: &Field) -> String {
    let unit = field.rule().and_then(|rule| rule.unit);
    let absent = match field.default {
        Default::Required => match field.ground {
            None => "required".to_owned(),
            Some(GroundKind::Channel) => "required in a channel".to_owned(),
            Some(GroundKind::Terrain) => "required on a terrain".to_owned(),
        },
        Default::Words(words) => words.to_owned(),
        _ => format!("`{}`", json(&default(field).unwrap_or(Value::Null))),
    };
    let about = schemas.get(section.schema);
    let about = about.and_then(|schema| description(schema, field.key));
    cells(
        &format!("{}{}", section.path, field.key),
        &about.unwrap_or_default(),
        unit,
        &absent,
        &field.allowed(),
    )
}

fn of_shapes(path: &str) -> Vec<String> {
    let kinds = SHAPES.iter().flat_map(|kind| {
        let path = format!("{path}.{}.", kind.name);
        kind.fields.iter().map(move |field| of_shape(&path, field))
    });
    kinds.collect()
}

fn of_shape(path: &str, field: &ShapeField) -> String {
    let range = field.rule().map(|rule| rule.range.words());
    let range = range.unwrap_or_default();
    let allowed = match field.value {
        FieldValue::Number => range,
        FieldValue::Vector => format!("{range} each"),
        FieldValue::Points(least, most) => {
            format!("{range} each, {least} to {most} points that enclose something")
        }
        FieldValue::RegularSolid => {
            let names = REGULAR_SOLIDS.map(|(name, _)| format!("`\"{name}\"`"));
            names.join(" or ")
        }
    };
    let unit = field.rule().and_then(|rule| rule.unit);
    let name = format!("{path}{}", field.key());
    cells(&name, field.about, unit, "required", &allowed)
}

/// A row; the unit has a column of its own, so that it is left out of the meaning.
fn cells(name: &str, about: &str, unit: Option<&str>, default: &str, allowed: &str) -> String {
    let meaning = match unit {
        Some(unit) => about.replacen(&format!(" [{unit}]"), "", 1),
        None => about.to_owned(),
    };
    let meaning = meaning.trim_end_matches('.').replace('\n', " ");
    let unit = unit.unwrap_or("–");
    format!("| `{name}` | {meaning} | {unit} | {default} | {allowed} |")
}

/// JSON as people write it.
fn json(value: &Value) -> String {
    match value {
        Value::Number(number) => number.as_f64().map_or_else(|| value.to_string(), short),
        Value::Array(items) => {
            let items: Vec<String> = items.iter().map(json).collect();
            format!("[{}]", items.join(", "))
        }
        other => other.to_string(),
    }
}

/// Description of a property.
fn description(schema: &RefOr<Schema>, key: &str) -> Option<String> {
    let schema = serde_json::to_value(schema).ok()?;
    alternatives(&schema)
        .flat_map(|object| alternatives(&object["properties"][key]))
        .find_map(|property| property["description"].as_str().map(without_default))
        .map(ToOwned::to_owned)
}

/// A schema and those it lets choose from.
fn alternatives(schema: &Value) -> impl Iterator<Item = &Value> {
    let choices = schema["oneOf"].as_array().into_iter().flatten();
    std::iter::once(schema).chain(choices)
}
