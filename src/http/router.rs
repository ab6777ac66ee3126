//! Which request goes where, and what goes round all of them.

use super::problem::Problem;
use super::{jobs, plans, results, system};
use crate::config::Limits;
use crate::jobs::Jobs;
use axum::Router;
use axum::extract::{DefaultBodyLimit, Request};
use axum::http::{StatusCode, header};
use axum::middleware::{Next, from_fn};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use std::any::Any;
use std::time::Duration;
use tower_http::catch_panic::CatchPanicLayer;
use tower_http::trace::{DefaultMakeSpan, DefaultOnResponse, TraceLayer};
use tracing::Level;
use utoipa::openapi::{InfoBuilder, OpenApi, OpenApiBuilder};
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

/// All routes, with the limits round them.
pub fn router(jobs: Jobs, limits: &Limits) -> Router {
    let (router, contract) = documented().split_for_parts();
    let contract = contract_text(&contract);
    let timeout = limits.request_timeout();
    router
        .route("/openapi.json", get(|| serve_contract(contract)))
        .fallback(system::no_such_route)
        .method_not_allowed_fallback(system::wrong_method)
        .with_state(jobs)
        .layer(DefaultBodyLimit::max(limits.request_body_bytes))
        .layer(from_fn(move |request, next| {
            in_time(timeout, request, next)
        }))
        .layer(CatchPanicLayer::custom(after_panic))
        .layer(
            TraceLayer::new_for_http()
                .make_span_with(DefaultMakeSpan::new().level(Level::INFO))
                .on_response(DefaultOnResponse::new().level(Level::INFO)),
        )
}

/// The contract, made from the code.
pub fn openapi() -> OpenApi {
    documented().into_openapi()
}

fn documented() -> OpenApiRouter<Jobs> {
    OpenApiRouter::with_openapi(description())
        .routes(routes!(jobs::submit, jobs::list))
        .routes(routes!(jobs::show, jobs::dismiss))
        .routes(routes!(plans::plan))
        .routes(routes!(results::trajectory))
        .routes(routes!(results::flow))
        .routes(routes!(system::health))
}

fn description() -> OpenApi {
    let info = InfoBuilder::new()
        .title("Scree")
        .version(env!("CARGO_PKG_VERSION"))
        .description(Some(
            "Where does an object hit by a granular flow end up? Send a scenario as a job, \
             then read the body's trajectory. SI units; x downstream, y across, z up. Every \
             error is a problem document (RFC 9457).",
        ))
        .build();
    OpenApiBuilder::new().info(info).build()
}

fn contract_text(contract: &OpenApi) -> String {
    // A document of strings and maps can always be written.
    contract.to_pretty_json().unwrap_or_default()
}

async fn serve_contract(contract: String) -> Response {
    ([(header::CONTENT_TYPE, "application/json")], contract).into_response()
}

/// The answer, or a problem if its head is not there in time. A client that
/// sends its body slowly runs into this too.
async fn in_time(limit: Duration, request: Request, next: Next) -> Response {
    match tokio::time::timeout(limit, next.run(request)).await {
        Ok(response) => response,
        Err(_) => Problem::new(
            StatusCode::SERVICE_UNAVAILABLE,
            "timed-out",
            "Timed out",
            format!("the request took longer than {} s", limit.as_secs_f64()),
        )
        .into_response(),
    }
}

#[expect(
    clippy::needless_pass_by_value,
    reason = "the layer hands the panic over"
)]
fn after_panic(panic: Box<dyn Any + Send>) -> Response {
    let text = panic.downcast_ref::<&str>().copied();
    let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    Problem::internal(text.unwrap_or("a panic in a handler")).into_response()
}
