//! The shape of a body, from the table of all kinds of shapes.

use crate::jobs::submit::{FieldValue, REGULAR_SOLIDS, SHAPES, ShapeField, ShapeKind};
use serde::Serialize;
use std::borrow::Cow;
use utoipa::openapi::schema::{
    ArrayBuilder, KnownFormat, ObjectBuilder, OneOfBuilder, RefBuilder, Type,
};
use utoipa::openapi::{RefOr, Schema, SchemaFormat};
use utoipa::{PartialSchema, ToSchema};

/// Shape of a body before rounding; rounding does not move its faces.
#[derive(Debug, Serialize)]
pub struct ShapeDocument;

/// Name of the schema of regular solids.
const REGULAR_SOLID: &str = "RegularSolid";

impl PartialSchema for ShapeDocument {
    fn schema() -> RefOr<Schema> {
        let about = "Shape of a body before rounding; rounding does not move its faces.";
        let kinds = OneOfBuilder::new().description(Some(about));
        SHAPES
            .iter()
            .map(kind)
            .fold(kinds, OneOfBuilder::item)
            .into()
    }
}

impl ToSchema for ShapeDocument {
    fn name() -> Cow<'static, str> {
        Cow::Borrowed("Shape")
    }

    fn schemas(schemas: &mut Vec<(String, RefOr<Schema>)>) {
        let names = REGULAR_SOLIDS.map(|(name, _)| name);
        let solids = ObjectBuilder::new()
            .schema_type(Type::String)
            .description(Some("A solid with equal regular faces."))
            .enum_values(Some(names));
        schemas.push((REGULAR_SOLID.to_owned(), solids.into()));
    }
}

/// An object with the name of one kind.
fn kind(kind: &ShapeKind) -> Schema {
    let fields = ObjectBuilder::new().description(Some(kind.about));
    let fields = kind.fields.iter().fold(fields, |object, field| {
        object
            .property(field.key(), value(field))
            .required(field.key())
    });
    ObjectBuilder::new()
        .description(Some(kind.about))
        .property(kind.name, fields)
        .required(kind.name)
        .into()
}

fn value(field: &ShapeField) -> RefOr<Schema> {
    let about = Some(field.about);
    match field.value {
        FieldValue::Number => number().description(about).into(),
        FieldValue::Vector => ArrayBuilder::new()
            .items(number())
            .description(about)
            .into(),
        FieldValue::Points(least, most) => ArrayBuilder::new()
            .items(ArrayBuilder::new().items(number()))
            .description(about)
            .min_items(Some(least))
            .max_items(Some(most))
            .into(),
        FieldValue::RegularSolid => RefBuilder::new()
            .ref_location_from_schema_name(REGULAR_SOLID)
            .description(about)
            .into(),
    }
}

fn number() -> ObjectBuilder {
    ObjectBuilder::new()
        .schema_type(Type::Number)
        .format(Some(SchemaFormat::KnownFormat(KnownFormat::Double)))
}
