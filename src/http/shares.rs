//! Shares of a caller (token or address) in what is scarce: requests in progress, turns of reading
//! requests, and streams.

use super::access::Caller;
use super::operator::is_operators;
use super::problem::Problem;
use super::tracked_body::TrackedBody;
use super::turns::{Turn, Turns};
use crate::config::Limits;
use crate::quota::{InUse, Quota, UsedUp};
use axum::body::Body;
use axum::extract::{FromRequestParts, Request, State};
use axum::http::Method;
use axum::http::request::Parts;
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use std::sync::{Arc, Mutex, PoisonError};

/// Quotas of requests in progress and of streams, and turns of reading requests.
#[derive(Debug, Clone)]
pub(super) struct Shares {
    requests: Quota,
    streams: Quota,
    turns: Turns,
}

/// Right of a request to wait or to become a stream, with which its turn ends.
#[derive(Debug, Clone)]
pub(super) struct StreamRight {
    streams: Quota,
    caller: String,
    turn: Arc<Mutex<Option<Turn>>>,
}

impl Shares {
    pub(super) fn new(limits: &Limits) -> Self {
        Self {
            requests: Quota::new(limits.connections, limits.connections_per_address),
            streams: Quota::new(limits.streams, limits.streams_per_caller),
            turns: Turns::default(),
        }
    }
}

impl StreamRight {
    /// A place for a stream, until this is dropped.
    ///
    /// # Errors
    /// There are as many streams as the service, or the caller, may have.
    pub(super) fn enter(&self) -> Result<InUse, Problem> {
        self.end_turn();
        self.streams
            .enter(&self.caller)
            .map_err(|used_up| match used_up {
                UsedUp::ByAll(streams) => spent(
                    "streams-full",
                    streams,
                    "streams are open",
                    "limits.streams",
                ),
                UsedUp::ByCaller(streams) => spent(
                    "streams-spent",
                    streams,
                    "streams of this caller are open",
                    "limits.streams_per_caller",
                ),
            })
    }

    /// Ends the turn of a request that is about to wait, so that others of its caller have theirs.
    pub(super) fn end_turn(&self) {
        let mut turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        drop(turn.take());
    }
}

impl<S: Send + Sync> FromRequestParts<S> for StreamRight {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, _state: &S) -> Result<Self, Problem> {
        // Inserted by `limit`, which every request passes.
        let right = parts.extensions.get::<Self>().cloned();
        right.ok_or_else(|| Problem::internal("a request without a share"))
    }
}

/// Passes a request on if its caller has not too many in progress; the operator's always.
pub(super) async fn limit(
    State(shares): State<Shares>,
    caller: Caller,
    mut request: Request,
    next: Next,
) -> Response {
    let caller = caller.share();
    if is_operators(request.method(), request.uri().path()) {
        return next.run(request).await;
    }
    match shares.requests.enter(&caller) {
        Ok(in_use) => {
            let turn = match *request.method() {
                // What is submitted takes turns in the admission pool.
                Method::POST => None,
                _ => Some(shares.turns.take(&caller).await),
            };
            let right = StreamRight {
                streams: shares.streams,
                caller,
                turn: Arc::new(Mutex::new(turn)),
            };
            request.extensions_mut().insert(right.clone());
            let response = next.run(request).await;
            right.end_turn();
            response.map(|body| Body::new(TrackedBody::new(body, in_use)))
        }
        Err(UsedUp::ByAll(requests)) => spent(
            "requests-full",
            requests,
            "requests are in progress",
            "limits.connections",
        )
        .into_response(),
        Err(UsedUp::ByCaller(requests)) => spent(
            "requests-spent",
            requests,
            "requests of this caller are in progress",
            "limits.connections_per_address",
        )
        .into_response(),
    }
}

fn spent(kind: &str, number: usize, what: &str, limit: &str) -> Problem {
    let detail = format!("{number} {what}, as many as {limit} of this service allows");
    Problem::busy(kind, "Too many at a time", &detail)
}
