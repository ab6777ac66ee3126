//! Examples of the contract: requests and answers of a real service, kept in `api/examples`.

use serde_json::{Map, Value};
use utoipa::openapi::example::ExampleBuilder;
use utoipa::openapi::path::Operation;
use utoipa::openapi::{Components, Content, Ref, RefOr};

/// JSON documents, by the names of their schemas.
const DOCUMENTS: [(&str, &str); 18] = [
    ("Batch", include_str!("../../api/examples/batch.json")),
    (
        "BatchAnswer",
        include_str!("../../api/examples/batch-answer.json"),
    ),
    (
        "FlowSnapshot",
        include_str!("../../api/examples/flow-snapshot.json"),
    ),
    ("Health", include_str!("../../api/examples/health.json")),
    ("Job", include_str!("../../api/examples/job.json")),
    ("JobPage", include_str!("../../api/examples/job-page.json")),
    ("Planned", include_str!("../../api/examples/planned.json")),
    (
        "StoredTerrain",
        include_str!("../../api/examples/terrain.json"),
    ),
    (
        "TerrainPage",
        include_str!("../../api/examples/terrain-page.json"),
    ),
    (
        "Trajectory",
        include_str!("../../api/examples/trajectory.json"),
    ),
    (
        "LandingPage",
        include_str!("../../api/examples/ogc/landing-page.json"),
    ),
    (
        "Conformance",
        include_str!("../../api/examples/ogc/conformance.json"),
    ),
    (
        "ProcessList",
        include_str!("../../api/examples/ogc/process-list.json"),
    ),
    (
        "ProcessDescription",
        include_str!("../../api/examples/ogc/process-description.json"),
    ),
    (
        "Execute",
        include_str!("../../api/examples/ogc/execute.json"),
    ),
    (
        "StatusInfo",
        include_str!("../../api/examples/ogc/status-info.json"),
    ),
    (
        "JobList",
        include_str!("../../api/examples/ogc/job-list.json"),
    ),
    (
        "Results",
        include_str!("../../api/examples/ogc/results.json"),
    ),
];

/// Problem documents, by their status.
const PROBLEMS: &str = include_str!("../../api/examples/problems.json");

/// Other answers, by their media types.
const TEXTS: [(&str, &str); 4] = [
    (
        "application/openmetrics-text",
        include_str!("../../api/examples/metrics.txt"),
    ),
    (
        "application/x-ndjson",
        include_str!("../../api/examples/trajectory.ndjson"),
    ),
    (
        "text/csv",
        include_str!("../../api/examples/trajectory.csv"),
    ),
    (
        "text/event-stream",
        include_str!("../../api/examples/events.txt"),
    ),
];

/// Examples of problems by their status; those of a query end in `-query`.
type Problems = Map<String, Value>;

/// Adds the examples to the components of the contract; the requests refer to them.
pub(super) fn add_to(components: &mut Components, problems: Problems) {
    let documents = DOCUMENTS.map(|(name, text)| (name.to_owned(), json(text)));
    let problems = problems
        .into_iter()
        .map(|(name, problem)| (of_problem(&name), Some(problem)));
    let texts = TEXTS.map(|(media_type, text)| (of_text(media_type), Some(Value::from(text))));
    for (name, value) in documents.into_iter().chain(problems).chain(texts) {
        let example = ExampleBuilder::new().value(value).build();
        components.examples.insert(name, example.into());
    }
}

/// Refers to an example for the body of a request and for its answers.
pub(super) fn refer(operation: &mut Operation, problems: &Problems) {
    let has_body = operation.request_body.is_some();
    if let Some(RefOr::T(body)) = &mut operation.request_body {
        for (media_type, content) in &mut body.content {
            refer_content(content, |schema| example(media_type, schema));
        }
    }
    for (status, response) in &mut operation.responses.responses {
        let RefOr::T(response) = response else {
            continue;
        };
        for (media_type, content) in &mut response.content {
            refer_content(content, |schema| match schema {
                Some("Problem") => problem(problems, status, has_body),
                schema => example(media_type, schema),
            });
        }
    }
}

fn refer_content(content: &mut RefOr<Content>, name: impl FnOnce(Option<&str>) -> Option<String>) {
    let RefOr::T(content) = content else { return };
    let schema = match &content.schema {
        Some(RefOr::Ref(schema)) => schema.ref_location.rsplit('/').next(),
        _ => None,
    };
    if let Some(name) = name(schema) {
        let place = Ref::new(format!("#/components/examples/{name}"));
        content.examples.insert(name, RefOr::Ref(place));
    }
}

/// Name of the example of a document or text.
fn example(media_type: &str, schema: Option<&str>) -> Option<String> {
    let document = DOCUMENTS.iter().find(|(name, _)| Some(*name) == schema);
    let text = TEXTS.iter().find(|(name, _)| *name == media_type);
    match (document, text) {
        (Some((name, _)), _) => Some((*name).to_owned()),
        (None, Some((media_type, _))) => Some(of_text(media_type)),
        (None, None) => None,
    }
}

/// Name of the example of a problem, of a request with a body or else of one by its query.
fn problem(problems: &Problems, status: &str, has_body: bool) -> Option<String> {
    let of_query = format!("{status}-query");
    if !has_body && problems.contains_key(&of_query) {
        return Some(of_problem(&of_query));
    }
    problems.contains_key(status).then(|| of_problem(status))
}

fn of_problem(name: &str) -> String {
    format!("Problem-{name}")
}

fn of_text(media_type: &str) -> String {
    media_type.replace('/', "-")
}

/// The examples of problems.
pub(super) fn problems() -> Problems {
    match json(PROBLEMS) {
        Some(Value::Object(problems)) => problems,
        _ => Map::new(),
    }
}

/// A file as JSON, which a test checks.
fn json(text: &str) -> Option<Value> {
    serde_json::from_str(text).ok()
}
