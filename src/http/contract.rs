//! The contract: what holds for all requests, beside what each handler says of itself.

use super::access::is_open;
use super::{common_answers, examples, ogc, vector_lengths};
use crate::jobs::documents::complete;
use axum::body::Bytes;
use utoipa::openapi::header::Header;
use utoipa::openapi::path::Operation;
use utoipa::openapi::schema::{KnownFormat, ObjectBuilder, Type};
use utoipa::openapi::security::{Http, HttpAuthScheme, SecurityRequirement, SecurityScheme};
use utoipa::openapi::tag::{Tag, TagBuilder};
use utoipa::openapi::{
    ContactBuilder, InfoBuilder, LicenseBuilder, OpenApi, OpenApiBuilder, RefOr, Response,
    SchemaFormat, ServerBuilder,
};

/// Groups of requests, in reading order.
const TAGS: [(&str, &str); 7] = [
    (
        "plans",
        "What a job would compute and cost, before it is submitted.",
    ),
    (
        "jobs",
        "Submit scenarios, follow their jobs, dismiss and remove them.",
    ),
    (
        "terrains",
        "Upload the rasters that scenarios name, and read them.",
    ),
    (
        "results",
        "Trajectories of bodies, and snapshots of the flow.",
    ),
    (
        "studies",
        "One scenario with uncertain inputs: submit, follow and enlarge a study, and read its answers.",
    ),
    (
        "service",
        "Health and figures of the service, for its operator.",
    ),
    (
        ogc::TAG,
        "The same jobs as OGC API – Processes, Part 1, has them.",
    ),
];

/// Name of the security scheme.
const TOKEN: &str = "token";

/// The contract without its requests.
pub(super) fn begin() -> OpenApi {
    let license = LicenseBuilder::new()
        .name("MIT OR Apache-2.0")
        .identifier(Some("MIT OR Apache-2.0"))
        .build();
    let info = InfoBuilder::new()
        .title("Scree")
        .version(env!("CARGO_PKG_VERSION"))
        .license(Some(license))
        .contact(Some(ContactBuilder::new().name(Some("Scree")).build()))
        .description(Some(
            "Where does an object hit by a granular flow end up? Send a scenario as a job, \
             then read the body's trajectory. SI units; x downstream, y across, z up. Every \
             error is a problem document (RFC 9457).",
        ))
        .build();
    let here = ServerBuilder::new()
        .url("/")
        .description(Some("The service that serves this document"))
        .build();
    OpenApiBuilder::new()
        .info(info)
        .servers(Some([here]))
        .tags(Some(TAGS.map(tag)))
        // A service without tokens asks for none.
        .security(Some([SecurityRequirement::default(), requirement()]))
        .build()
}

fn tag((name, about): (&str, &str)) -> Tag {
    TagBuilder::new()
        .name(name)
        .description(Some(about))
        .build()
}

fn requirement() -> SecurityRequirement {
    SecurityRequirement::new(TOKEN, Vec::<String>::new())
}

/// Adds what all requests have in common.
pub(super) fn finish(contract: &mut OpenApi) {
    let problems = examples::problems();
    for (path, item) in &mut contract.paths.paths {
        for operation in [
            &mut item.get,
            &mut item.post,
            &mut item.patch,
            &mut item.delete,
        ] {
            let Some(operation) = operation else { continue };
            common_answers::add(path, operation);
            if is_open(path) {
                operation.security = Some(Vec::new());
            }
            add_headers(operation);
            examples::refer(operation, &problems);
        }
    }
    if let Some(components) = &mut contract.components {
        let token = Http::builder()
            .scheme(HttpAuthScheme::Bearer)
            .description(Some(
                "An access token (`scree token`), where the service has any.",
            ))
            .build();
        components.add_security_scheme(TOKEN, SecurityScheme::Http(token));
        complete(&mut components.schemas);
        vector_lengths::add(&mut components.schemas);
        examples::add_to(components, problems);
    }
}

/// Headers that any answer has, or all of a status.
fn add_headers(operation: &mut Operation) {
    let revalidates = operation.responses.responses.contains_key("304");
    for (status, response) in &mut operation.responses.responses {
        let RefOr::T(response) = response else {
            continue;
        };
        let about = "Identifier of the request, which the service's log has, too";
        let uuid = SchemaFormat::KnownFormat(KnownFormat::Uuid);
        let id = value(Type::String).format(Some(uuid));
        add_header(response, "X-Request-Id", id, about);
        if is_kept(response) {
            let about = "Name of the file in which the answer is kept";
            add_header(response, "Content-Disposition", value(Type::String), about);
        }
        if status == "200" && revalidates {
            let about = "Name of this content, compressed or not, for `If-None-Match`";
            add_header(response, "ETag", value(Type::String), about);
        }
        if status == "429" || status == "503" {
            let about = "Seconds after which a retry may succeed";
            add_header(response, "Retry-After", value(Type::Integer), about);
        }
    }
}

/// True if an answer is a file to keep in each of its formats.
fn is_kept(response: &Response) -> bool {
    let kept = ["application/zip", "application/x-ndjson", "text/csv"];
    let mut media_types = response.content.keys();
    !response.content.is_empty() && media_types.all(|kind| kept.contains(&kind.as_str()))
}

fn value(kind: Type) -> ObjectBuilder {
    ObjectBuilder::new().schema_type(kind)
}

/// Adds a header, unless the request describes it itself.
fn add_header(response: &mut Response, name: &str, value: ObjectBuilder, about: &str) {
    let mut header = Header::new(value);
    header.description = Some(about.to_owned());
    let headers = &mut response.headers;
    headers
        .entry(name.to_owned())
        .or_insert_with(|| header.into());
}

/// The contract as text.
pub(super) fn text_of(contract: &OpenApi) -> Bytes {
    // A document of strings and maps can always be serialised.
    contract.to_pretty_json().unwrap_or_default().into()
}
