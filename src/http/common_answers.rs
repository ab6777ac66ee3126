//! Answers that any request may get, added to the contract in one place.

use super::access::is_open;
use super::problem::MEDIA_TYPE_TEXT;
use utoipa::openapi::path::{Operation, Parameter, ParameterIn};
use utoipa::openapi::{ContentBuilder, Ref, RefOr, ResponseBuilder};

/// Adds the common answers to a request of the contract.
pub(super) fn add(path: &str, operation: &mut Operation) {
    let mut why_forbidden = "The request is for a name that is not the service's, or from \
                             a page that may not use it";
    if !is_open(path) {
        answer(
            operation,
            "401",
            "No good access token, where one is needed",
        );
        why_forbidden = "The access token is not good for this, the request is for a name \
                         that is not the service's, or from a page that may not use it";
    }
    if path.contains("{id}") {
        answer(operation, "404", "There is no such job");
    }
    if operation.parameters.iter().flatten().any(is_of_query) {
        answer(operation, "422", "A parameter is not allowed");
    }
    answer(operation, "400", "The header Host is missing or malformed");
    answer(operation, "403", why_forbidden);
    answer(
        operation,
        "429",
        "The caller has too many requests in progress, or waits for too many jobs; try \
         again after `Retry-After` seconds",
    );
    answer(
        operation,
        "500",
        "A defect; the log has the details under `error_id`",
    );
    answer(
        operation,
        "503",
        "It took too long, all connections are busy, or the database can't be used now",
    );
}

fn is_of_query(parameter: &RefOr<Parameter>) -> bool {
    matches!(parameter, RefOr::T(parameter) if parameter.parameter_in == ParameterIn::Query)
}

/// Adds a problem document, unless the request describes that status itself.
fn answer(operation: &mut Operation, status: &str, description: &str) {
    let problem = ContentBuilder::new().schema(Some(Ref::from_schema_name("Problem")));
    let response = ResponseBuilder::new()
        .description(description)
        .content(MEDIA_TYPE_TEXT, problem.build());
    let responses = &mut operation.responses.responses;
    responses
        .entry(status.to_owned())
        .or_insert_with(|| response.build().into());
}
