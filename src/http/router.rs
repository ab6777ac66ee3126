//! Routes of requests, and the layers around them.

use super::access::{self, Gate};
use super::browser::{self, Doors};
use super::metrics::{self, RequestCounts};
use super::problem::Problem;
use super::scenario_body::BodyLimits;
use super::services::Services;
use super::shares::{self, Shares};
use super::static_text::StaticText;
use super::{
    batch, compression, contract, drawings, events, flow, jobs, listing, maps, ogc, page, plans,
    studies, submission, system, terrains, trajectory,
};
use crate::config::ServiceConfig;
use crate::jobs::submit::excerpt;
use axum::extract::{DefaultBodyLimit, Request};
use axum::http::{HeaderMap, HeaderValue, StatusCode};
use axum::middleware::{Next, from_fn, from_fn_with_state};
use axum::response::{IntoResponse, Response};
use axum::routing::{MethodRouter, get};
use axum::{Extension, Router};
use std::any::Any;
use std::time::Duration;
use tokio::task::spawn_blocking;
use tokio::time::Instant;
use tower_http::catch_panic::CatchPanicLayer;
use tower_http::trace::{DefaultOnResponse, TraceLayer};
use tracing::{Level, Span};
use utoipa::openapi::OpenApi;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;
use uuid::Uuid;

/// All routes, with the layers around them.
pub fn router(services: Services, config: &ServiceConfig) -> Router {
    let limits = &config.limits;
    // Nobody waits for it.
    drop(spawn_blocking(page::prepare));
    let (router, contract) = documented(limits.request_timeout()).split_for_parts();
    let process = ogc::Process::of(&contract);
    let contract = StaticText::new("application/json", contract::text_of(&contract));
    let body_timeout = limits.body_read_timeout();
    let body_bytes = limits.request_body_bytes;
    let router = router
        .route("/openapi.json", always(contract))
        .merge(ogc::beside_the_contract())
        .route("/", get(page::page))
        .route("/docs", get(page::page))
        .route("/assets/{file}", get(page::page))
        .fallback(system::no_such_route)
        .method_not_allowed_fallback(system::wrong_method)
        .with_state(services)
        .layer(Extension(process))
        .layer(DefaultBodyLimit::max(body_bytes))
        .layer(from_fn(move |request, next| {
            limit_body(body_timeout, body_bytes, request, next)
        }))
        .layer(from_fn_with_state(Shares::new(limits), shares::limit))
        .layer(from_fn_with_state(Gate::new(&config.tokens), access::check))
        .layer(from_fn_with_state(Doors::new(config), browser::check))
        .layer(from_fn(compression::compress));
    let router = match browser::cors(config) {
        Some(cors) => router.layer(cors),
        None => router,
    };
    router
        .layer(CatchPanicLayer::custom(after_panic))
        .layer(from_fn(browser::harden))
        .layer(from_fn(metrics::count))
        .layer(Extension(RequestCounts::default()))
        .layer(
            TraceLayer::new_for_http()
                .make_span_with(span)
                .on_response(DefaultOnResponse::new().level(Level::INFO)),
        )
        .layer(from_fn(with_id))
}

/// The contract, generated from the code.
pub fn openapi() -> OpenApi {
    documented(Duration::MAX).into_openapi()
}

/// The routes; those that wait by design have no time limit.
fn documented(limit: Duration) -> OpenApiRouter<Services> {
    let quick = OpenApiRouter::new()
        .routes(routes!(listing::list))
        .routes(routes!(trajectory::trajectory))
        .routes(routes!(trajectory::trajectory_csv))
        .routes(routes!(trajectory::trajectory_ndjson))
        .routes(routes!(trajectory::trajectory_npz))
        .routes(routes!(flow::flow))
        .routes(routes!(flow::flow_frames))
        .routes(routes!(flow::flow_archive))
        .routes(routes!(maps::list_maps))
        .routes(routes!(maps::map_file))
        .routes(routes!(maps::tracks))
        .routes(routes!(drawings::aerial))
        .routes(routes!(drawings::motion))
        .routes(routes!(system::health))
        .routes(routes!(system::ready))
        .routes(routes!(metrics::metrics))
        .merge(studies::quick())
        .merge(terrains::quick())
        .merge(ogc::quick())
        .layer(from_fn(move |request, next| in_time(limit, request, next)));
    let mut all = OpenApiRouter::with_openapi(contract::begin())
        .routes(routes!(jobs::show, jobs::dismiss))
        .routes(routes!(events::events))
        // The admission pool limits their time: what is being stored is carried through.
        .routes(routes!(submission::submit))
        .routes(routes!(batch::submit_batch))
        .routes(routes!(plans::plan))
        .merge(studies::submitting())
        .merge(terrains::uploading())
        .merge(ogc::waiting())
        .merge(quick);
    contract::finish(all.get_openapi_mut());
    all
}

/// Identifier of a request in the log and in its answer.
#[derive(Debug, Clone)]
struct RequestId(String);

async fn with_id(mut request: Request, next: Next) -> Response {
    let id = Uuid::now_v7().to_string();
    // Hexadecimal digits and dashes are valid in a header.
    let header = HeaderValue::from_str(&id).ok();
    request.extensions_mut().insert(RequestId(id));
    let mut response = next.run(request).await;
    if let Some(header) = header {
        response.headers_mut().insert("x-request-id", header);
    }
    response
}

fn span<B>(request: &axum::http::Request<B>) -> Span {
    let id = request.extensions().get::<RequestId>();
    let id = id.map_or("", |id| id.0.as_str());
    // A client must not fill the log with one request.
    let uri = excerpt(&request.uri().to_string());
    tracing::info_span!("request", id, method = %request.method(), uri)
}

async fn limit_body(time: Duration, bytes: usize, mut request: Request, next: Next) -> Response {
    let deadline = Instant::now() + time;
    request
        .extensions_mut()
        .insert(BodyLimits { deadline, bytes });
    next.run(request).await
}

/// A route that always has the same text.
fn always(text: StaticText) -> MethodRouter<Services> {
    get(move |headers: HeaderMap| async move { text.answer(&headers) })
}

/// The answer, or a problem if its head is not ready in time.
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
