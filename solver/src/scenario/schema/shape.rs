//! The shape of a body, from the table of all kinds of shapes.

use super::{capitalised, limit_number};
use crate::scenario::{FieldValue, REGULAR_SOLIDS, SHAPES, Shape, ShapeField, ShapeKind};
use std::borrow::Cow;
use utoipa::openapi::schema::{
    AdditionalProperties, ArrayBuilder, KnownFormat, ObjectBuilder, OneOfBuilder, RefBuilder, Type,
};
use utoipa::openapi::{Ref, RefOr, Schema, SchemaFormat};
use utoipa::{PartialSchema, ToSchema};

/// Name of the schema of regular solids.
const REGULAR_SOLID: &str = "RegularSolid";

impl PartialSchema for Shape {
    fn schema() -> RefOr<Schema> {
        let about = "Shape of a body before rounding; rounding does not move its faces.";
        let kinds = OneOfBuilder::new().description(Some(about));
        SHAPES
            .iter()
            .map(|kind| Ref::from_schema_name(shape_name(kind)))
            .fold(kinds, OneOfBuilder::item)
            .into()
    }
}

impl ToSchema for Shape {
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
        for kind in &SHAPES {
            schemas.push((capitalised(kind.name), dimensions(kind).into()));
            schemas.push((shape_name(kind), shape(kind).into()));
        }
    }
}

/// Name of the schema of a shape of this kind. Each has one of its own, so that clients made from
/// the contract have a type for it.
fn shape_name(kind: &ShapeKind) -> String {
    capitalised(kind.name) + "Shape"
}

/// An object with the name of this kind alone.
fn shape(kind: &ShapeKind) -> Schema {
    closed()
        .description(Some(kind.about))
        .property(kind.name, Ref::from_schema_name(capitalised(kind.name)))
        .required(kind.name)
        .into()
}

fn dimensions(kind: &ShapeKind) -> Schema {
    let fields = closed().description(Some(kind.about));
    let fields = kind.fields.iter().fold(fields, |object, field| {
        object
            .property(field.key(), value(field))
            .required(field.key())
    });
    fields.into()
}

/// An object without further keys.
fn closed() -> ObjectBuilder {
    ObjectBuilder::new()
        .additional_properties(Some(AdditionalProperties::<Schema>::FreeForm(false)))
}

fn value(field: &ShapeField) -> RefOr<Schema> {
    let about = Some(field.about);
    match field.value {
        FieldValue::Number => number(field).description(about).into(),
        FieldValue::Vector => vector(field).description(about).into(),
        FieldValue::Points(least, most) => ArrayBuilder::new()
            .items(vector(field))
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

fn number(field: &ShapeField) -> ObjectBuilder {
    let mut number = ObjectBuilder::new()
        .schema_type(Type::Number)
        .format(Some(SchemaFormat::KnownFormat(KnownFormat::Double)))
        .build();
    if let Some(rule) = field.rule() {
        limit_number(&mut number, &rule, false);
    }
    number.into()
}

fn vector(field: &ShapeField) -> ArrayBuilder {
    ArrayBuilder::new()
        .items(number(field))
        .min_items(Some(3))
        .max_items(Some(3))
}
