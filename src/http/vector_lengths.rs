//! Lengths of the vectors in lists, which the structs' own schemas don't tell.

use crate::results::table::Field;
use std::collections::BTreeMap;
use utoipa::openapi::RefOr;
use utoipa::openapi::schema::{Array, ArrayItems, Schema};

type Schemas = BTreeMap<String, RefOr<Schema>>;

/// Adds the lengths to the documents that contain lists of vectors.
pub(super) fn add(schemas: &mut Schemas) {
    for field in Field::all() {
        let length = field.components();
        if length > 1 {
            set(schemas, "TrajectoryColumns", field.name(), length);
        }
    }
    set(schemas, "FlowSnapshot", "position_m", 3);
    set(schemas, "MassProperties", "principal_axes", 3);
}

fn set(schemas: &mut Schemas, document: &str, property: &str, length: usize) {
    if let Some(vector) = vector_in(schemas, document, property) {
        (vector.min_items, vector.max_items) = (Some(length), Some(length));
    }
}

/// Schema of the entries of a list in a document.
fn vector_in<'a>(
    schemas: &'a mut Schemas,
    document: &str,
    property: &str,
) -> Option<&'a mut Array> {
    let RefOr::T(Schema::Object(document)) = schemas.get_mut(document)? else {
        return None;
    };
    let list = array(document.properties.get_mut(property)?)?;
    match &mut list.items {
        ArrayItems::RefOrSchema(items) => array(items),
        ArrayItems::False => None,
    }
}

fn array(schema: &mut RefOr<Schema>) -> Option<&mut Array> {
    match schema {
        RefOr::T(Schema::Array(array)) => Some(array),
        _ => None,
    }
}
