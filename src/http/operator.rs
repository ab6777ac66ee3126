//! The operator's requests, for which connections are kept.

use super::connections::Place;
use super::problem::Problem;
use axum::http::{Method, Request, StatusCode};
use axum::response::{IntoResponse, Response};

/// Seconds after which a client may retry if all connections are busy.
const RETRY_AFTER_S: u8 = 5;

/// The refusal of a request that is not the operator's on a connection that is kept for these.
pub(super) fn refusal<B>(place: Place, request: &Request<B>) -> Option<Response> {
    if place == Place::Client || is_operators(request.method(), request.uri().path()) {
        return None;
    }
    let problem = Problem::new(
        StatusCode::SERVICE_UNAVAILABLE,
        "connections-full",
        "Too many connections",
        "all connections of this service (limits.connections), or of this address \
         (limits.connections_per_address), are busy; try again later",
    )
    .retry_after(RETRY_AFTER_S);
    Some(problem.into_response())
}

/// True for health, readiness, metrics and dismissals.
pub(super) fn is_operators(method: &Method, path: &str) -> bool {
    let reads = method == Method::GET || method == Method::HEAD;
    (reads && ["/healthz", "/readyz", "/metrics"].contains(&path))
        || (method == Method::DELETE && path.starts_with("/v1/jobs/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kept_connection_serves_health_and_dismissals_and_nothing_else() {
        let refused = |place, method: &str, path: &str| {
            let request = Request::builder()
                .method(method)
                .uri(path)
                .body(())
                .unwrap();
            refusal(place, &request).map(|response| response.status())
        };
        for (method, path) in [
            ("GET", "/healthz"),
            ("GET", "/readyz"),
            ("GET", "/metrics"),
            ("DELETE", "/v1/jobs/1"),
        ] {
            assert_eq!(refused(Place::Operator, method, path), None);
        }
        for (method, path) in [
            ("GET", "/v1/jobs"),
            ("POST", "/v1/jobs"),
            ("POST", "/healthz"),
        ] {
            let status = refused(Place::Operator, method, path);
            assert_eq!(status, Some(StatusCode::SERVICE_UNAVAILABLE), "{path}");
            assert_eq!(refused(Place::Client, method, path), None);
        }
    }
}
