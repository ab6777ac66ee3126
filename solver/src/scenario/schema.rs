//! The scenario's JSON Schema: structs describe themselves, and the table of fields adds ranges,
//! units, defaults, and which fields must be given.

mod shape;
mod tables;

use super::fields::{Default, Field, GroundKind, Kind, SECTIONS};
use super::range::{Range, Rule};
use serde_json::Value;
use std::collections::BTreeMap;
pub use tables::tables;
use utoipa::Number;
use utoipa::openapi::extensions::ExtensionsBuilder;
use utoipa::openapi::schema::{AdditionalProperties, Array, ArrayItems, Object};
use utoipa::openapi::{RefOr, Schema};

/// Schemas by their names.
pub(super) type Schemas = BTreeMap<String, RefOr<Schema>>;

/// The shortest scenario with a flow and a body, the example of the contract.
pub(super) const SHORTEST: &str = r#"{
  "channel": {"inclination_deg": 40, "incline_length_m": 1, "runout_length_m": 2},
  "flow": {"volume_m3": 0.01},
  "bodies": [{"shape": {"cube": {"side_m": 0.04}}}]
}"#;

/// Adds the table of fields to the derived schemas of the scenario's structs.
pub(crate) fn complete(schemas: &mut Schemas) {
    for name in FLATTENED {
        flatten(schemas, name);
    }
    for section in &SECTIONS {
        let mut of_words = BTreeMap::new();
        if let Some(schema) = schemas.get_mut(section.schema) {
            for object in objects(schema) {
                describe(object, section.fields);
                of_words.extend(section.fields.iter().filter_map(default_word));
            }
        }
        for (key, word) in of_words {
            if let Some(RefOr::T(Schema::Object(choice))) = schemas.get_mut(&capitalised(key)) {
                choice.default = Some(word);
            }
        }
    }
    if let Some(RefOr::T(Schema::Object(scenario))) = schemas.get_mut("Scenario") {
        scenario.examples = serde_json::from_str(SHORTEST).into_iter().collect();
    }
}

/// Structs with members that stand among their own fields.
const FLATTENED: [&str; 2] = ["Scenario", "Flow"];

/// Makes one object of a struct and its members that stand among its own fields.
fn flatten(schemas: &mut Schemas, name: &str) {
    let Some(RefOr::T(Schema::AllOf(parts))) = schemas.get(name).cloned() else {
        return;
    };
    let mut whole = Object::new();
    whole.description = parts.description;
    for part in parts.items {
        let part = match part {
            RefOr::Ref(reference) => {
                let name = reference.ref_location.rsplit('/').next();
                name.and_then(|name| schemas.remove(name))
            }
            part => Some(part),
        };
        if let Some(RefOr::T(Schema::Object(part))) = part {
            whole.properties.extend(part.properties);
            whole.required.extend(part.required);
        }
    }
    schemas.insert(name.to_owned(), RefOr::T(Schema::Object(whole)));
}

/// The object a schema describes, or all it lets choose from.
fn objects(schema: &mut RefOr<Schema>) -> Vec<&mut Object> {
    match schema {
        RefOr::T(Schema::Object(object)) => vec![object],
        RefOr::T(Schema::OneOf(kinds)) => kinds.items.iter_mut().flat_map(objects).collect(),
        _ => Vec::new(),
    }
}

fn describe(object: &mut Object, fields: &[Field]) {
    object.additional_properties = Some(Box::new(AdditionalProperties::FreeForm(false)));
    for field in fields {
        object.required.retain(|key| key != field.key);
        let Some(property) = object.properties.get_mut(field.key) else {
            continue;
        };
        // A motion is a table by its times.
        let always = field.ground.is_none() && field.default == Default::Required;
        if always || matches!(field.kind, Kind::List(..)) {
            object.required.push(field.key.to_owned());
        }
        if let RefOr::T(schema) = property {
            limit(schema, field);
        }
        let words = default_in_words(field, property);
        if let (Some(words), Some(about)) = (words, description(property)) {
            about.push_str(&format!("{DEFAULT_IN_WORDS}{words}."));
        }
    }
}

/// Start of the sentence on the default in a description.
const DEFAULT_IN_WORDS: &str = "\nDefault: ";

/// A description without the sentence on the default.
pub(super) fn without_default(description: &str) -> &str {
    let cut = description.split_once(DEFAULT_IN_WORDS);
    cut.map_or(description, |(about, _)| about)
}

/// The default, where the schema of a property can't hold it as a value: it follows from other
/// fields, or stands in a schema of its own.
fn default_in_words(field: &Field, property: &RefOr<Schema>) -> Option<String> {
    match (field.default, property) {
        (Default::Words(words), _) => Some(words.to_owned()),
        (Default::Required, _) => field.ground.map(|ground| {
            let place = match ground {
                GroundKind::Channel => "in a channel",
                GroundKind::Terrain => "on a terrain",
            };
            format!("none, required {place}")
        }),
        (_, RefOr::Ref(_)) => default(field).map(|value| format!("`{value}`")),
        _ => None,
    }
}

/// The description of a property of one kind.
fn description(property: &mut RefOr<Schema>) -> Option<&mut String> {
    match property {
        RefOr::Ref(reference) => Some(&mut reference.description),
        RefOr::T(Schema::Object(object)) => Some(object.description.get_or_insert_default()),
        RefOr::T(Schema::Array(array)) => Some(array.description.get_or_insert_default()),
        RefOr::T(_) => None,
    }
}

/// Writes range, unit and default of a field into its schema.
fn limit(schema: &mut Schema, field: &Field) {
    match (&field.kind, &mut *schema) {
        (Kind::Number(rule) | Kind::Whole(rule), Schema::Object(number)) => {
            limit_number(number, rule, matches!(field.kind, Kind::Whole(_)));
            number.default = default(field);
        }
        (Kind::Vector(rule, length), Schema::Array(array)) => {
            limit_vector(array, rule, *length);
            array.default = default(field);
        }
        (Kind::List(rule, count, _), Schema::Array(list)) => {
            (list.min_items, list.max_items) = (Some(*count.start()), Some(*count.end()));
            if let Some(Schema::Object(number)) = entries(list) {
                limit_number(number, rule, false);
            }
        }
        (Kind::Table(rule, length, count, _), Schema::Array(list)) => {
            (list.min_items, list.max_items) = (Some(*count.start()), Some(*count.end()));
            if let Some(Schema::Array(vector)) = entries(list) {
                limit_vector(vector, rule, *length);
            }
            list.default = default(field);
        }
        (Kind::Map, Schema::Object(name)) => {
            name.pattern = Some("^[0-9a-f]{64}$".to_owned());
            name.default = default(field);
        }
        (Kind::Text(most), Schema::Object(text)) => {
            text.max_length = Some(*most);
            text.default = default(field);
        }
        (Kind::Items(most), Schema::Array(items)) => items.max_items = Some(*most),
        (Kind::Flag, Schema::Object(flag)) => flag.default = default(field),
        // A choice that may be null.
        (_, Schema::OneOf(choice)) => choice.default = default(field),
        _ => {}
    }
}

/// A vector, or a table of vectors.
fn limit_vector(array: &mut Array, rule: &Rule, length: usize) {
    match entries(array) {
        Some(Schema::Object(number)) => {
            limit_number(number, rule, false);
            (array.min_items, array.max_items) = (Some(length), Some(length));
        }
        Some(Schema::Array(vector)) => limit_vector(vector, rule, length),
        _ => {}
    }
}

fn entries(array: &mut Array) -> Option<&mut Schema> {
    match &mut array.items {
        ArrayItems::RefOrSchema(items) => match &mut **items {
            RefOr::T(schema) => Some(schema),
            RefOr::Ref(_) => None,
        },
        ArrayItems::False => None,
    }
}

fn limit_number(number: &mut Object, rule: &Rule, whole: bool) {
    let exact = |value: f64| match whole {
        // The limits of whole numbers are whole, and far below 2^32.
        true => Number::Int(value as isize),
        false => Number::Float(value),
    };
    let Range {
        low,
        high,
        low_is_open,
    } = rule.range;
    (number.minimum, number.exclusive_minimum) = match low_is_open {
        true => (None, Some(exact(low))),
        false => (Some(exact(low)), None),
    };
    number.maximum = Some(exact(high));
    number.extensions = rule
        .unit
        .map(|unit| ExtensionsBuilder::new().add("x-unit", unit).build());
}

/// The default as JSON, if it is a value.
pub(super) fn default(field: &Field) -> Option<Value> {
    Some(match (&field.kind, field.default) {
        (_, Default::Automatic) => Value::Null,
        (_, Default::Json(text)) => serde_json::from_str(text).ok()?,
        (Kind::Whole(rule), Default::OfRule) => Value::from(rule.default? as u64),
        (Kind::Number(rule), Default::OfRule) => Value::from(rule.default?),
        (Kind::Vector(rule, length), Default::OfRule) => Value::from(vec![rule.default?; *length]),
        _ => return None,
    })
}

/// Key and default of a choice, whose schema stands apart from its property.
fn default_word(field: &Field) -> Option<(&'static str, Value)> {
    match field.kind {
        Kind::Words(_) => Some((field.key, default(field).filter(|word| !word.is_null())?)),
        _ => None,
    }
}

/// Name of a choice's schema: its key with a capital.
fn capitalised(key: &str) -> String {
    let (first, rest) = key.split_at(1);
    first.to_uppercase() + rest
}
