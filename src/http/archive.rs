//! Archives and pictures as the contract describes them, and the names under which answers are kept.

use axum::http::{HeaderName, header};
use std::borrow::Cow;
use utoipa::openapi::schema::{KnownFormat, ObjectBuilder, Schema, Type};
use utoipa::openapi::{RefOr, SchemaFormat};
use utoipa::{PartialSchema, ToSchema};

/// A ZIP archive.
pub(super) struct Archive;

impl PartialSchema for Archive {
    fn schema() -> RefOr<Schema> {
        binary("A ZIP archive.")
    }
}

impl ToSchema for Archive {
    fn name() -> Cow<'static, str> {
        Cow::Borrowed("Archive")
    }
}

/// A stream of frames of the flow.
pub(super) struct Frames;

impl PartialSchema for Frames {
    fn schema() -> RefOr<Schema> {
        binary("Snapshots of the flow in binary.")
    }
}

impl ToSchema for Frames {
    fn name() -> Cow<'static, str> {
        Cow::Borrowed("FlowFrames")
    }
}

/// Schema of bytes.
pub(super) fn binary(description: &str) -> RefOr<Schema> {
    ObjectBuilder::new()
        .schema_type(Type::String)
        .format(Some(SchemaFormat::KnownFormat(KnownFormat::Binary)))
        .description(Some(description))
        .into()
}

/// A picture.
pub(super) struct Svg;

impl PartialSchema for Svg {
    fn schema() -> RefOr<Schema> {
        ObjectBuilder::new()
            .schema_type(Type::String)
            .description(Some("An SVG document."))
            .into()
    }
}

impl ToSchema for Svg {
    fn name() -> Cow<'static, str> {
        Cow::Borrowed("Svg")
    }
}

/// Header that names the file in which an answer is kept.
pub(super) fn attachment(name: &str) -> [(HeaderName, String); 1] {
    let value = format!("attachment; filename=\"{name}\"");
    [(header::CONTENT_DISPOSITION, value)]
}
