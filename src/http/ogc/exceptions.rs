//! Exceptions that the standard names, as problem documents.

use super::super::problem::Problem;
use axum::http::StatusCode;

const NAMED: &str = "http://www.opengis.net/def/exceptions/ogcapi-processes-1/1.0/";

/// The same problem, under the standard's name if it has one.
pub(super) fn of_standard(problem: Problem) -> Problem {
    if problem.kind == "urn:scree:problem:unknown-job" {
        named("no-such-job", problem)
    } else {
        problem
    }
}

/// There is no process of this name.
pub(super) fn no_such_process(detail: String) -> Problem {
    named(
        "no-such-process",
        Problem::not_found("unknown-process", detail),
    )
}

/// The job has not ended.
pub(super) fn result_not_ready(detail: String) -> Problem {
    let problem = Problem::new(StatusCode::NOT_FOUND, "job-active", "Not ready", detail);
    named("result-not-ready", problem)
}

fn named(name: &str, problem: Problem) -> Problem {
    Problem {
        kind: format!("{NAMED}{name}"),
        ..problem
    }
}
