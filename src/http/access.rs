//! Access control: access tokens, their scopes, and the caller of a
//! request.

use super::problem::Problem;
use super::{ogc, page};
use crate::config::{Scope, Token};
use axum::extract::{FromRequestParts, Request, State};
use axum::http::request::Parts;
use axum::http::{HeaderMap, HeaderValue, Method, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use std::net::{IpAddr, Ipv6Addr};
use std::sync::Arc;

/// Paths open without a token besides those of the page: they reveal nothing about jobs.
const OPEN: [&str; 3] = ["/healthz", "/readyz", "/openapi.json"];

/// Address from which a request came.
#[derive(Debug, Clone, Copy)]
pub(super) struct PeerAddress(pub(super) IpAddr);

/// Sender of a request.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Caller {
    /// Any sender at this address: the service asks for no token.
    Anyone(IpAddr),
    /// Holder of this token.
    Holder(Arc<Token>),
}

/// The valid tokens.
#[derive(Debug, Clone)]
pub(super) struct Gate(Arc<[Arc<Token>]>);

impl Gate {
    pub(super) fn new(tokens: &[Token]) -> Self {
        Self(tokens.iter().cloned().map(Arc::new).collect())
    }

    /// The caller, if the request shows a valid token or none is required.
    fn caller(&self, address: IpAddr, headers: &HeaderMap) -> Option<Caller> {
        if self.0.is_empty() {
            return Some(Caller::Anyone(address));
        }
        let shown = bearer(headers)?;
        let hash = blake3::hash(shown.as_bytes());
        let mut found = None;
        // Every token is compared, in constant time, so that the duration
        // reveals nothing.
        for token in self.0.iter() {
            if token.is(&hash) {
                found = Some(token);
            }
        }
        found.map(|token| Caller::Holder(Arc::clone(token)))
    }
}

impl Caller {
    /// Name of the token.
    pub(super) fn name(&self) -> Option<&str> {
        match self {
            Self::Anyone(_) => None,
            Self::Holder(token) => Some(&token.name),
        }
    }

    /// Name under which the caller has its share of what is scarce: token, or else address.
    pub(super) fn share(&self) -> String {
        match self {
            Self::Anyone(address) => format!("address {address}"),
            Self::Holder(token) => format!("token {}", token.name),
        }
    }

    /// Largest number of jobs that may wait or run at a time.
    pub(super) fn quota(&self) -> Option<u32> {
        match self {
            Self::Anyone(_) => None,
            Self::Holder(token) => token.active_jobs,
        }
    }

    /// True if the caller has this scope.
    fn may(&self, scope: Scope) -> bool {
        match self {
            Self::Anyone(_) => true,
            Self::Holder(token) => token.may(scope),
        }
    }

    /// True if the caller may read a job submitted by `submitter`: everything with the scope
    /// `read`, with `submit` what it submitted.
    pub(super) fn may_read(&self, submitter: Option<&str>) -> bool {
        self.may(Scope::Read) || self.is(submitter)
    }

    /// True if the caller holds the token of this submitter.
    fn is(&self, submitter: Option<&str>) -> bool {
        self.name().is_some() && self.name() == submitter
    }

    /// Checks that the caller may read a job submitted by `submitter`.
    ///
    /// # Errors
    /// The job is another submitter's, and the token lacks the scope to read it.
    pub(super) fn must_read(&self, submitter: Option<&str>) -> Result<(), Problem> {
        if self.may_read(submitter) {
            return Ok(());
        }
        Err(forbidden(
            "the job is not this token's, which lacks the scope \"read\"",
        ))
    }

    /// Checks that the caller may change a job submitted by `submitter`.
    ///
    /// # Errors
    /// The job is another submitter's, and the token has no administrator's scope.
    pub(super) fn may_change(&self, submitter: Option<&str>) -> Result<(), Problem> {
        if self.may(Scope::Admin) || self.is(submitter) {
            return Ok(());
        }
        Err(forbidden(
            "what is to be changed is not this token's, which lacks the scope \"admin\"",
        ))
    }
}

impl<S: Send + Sync> FromRequestParts<S> for Caller {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, _state: &S) -> Result<Self, Problem> {
        // Inserted by `check`, which every request passes.
        let caller = parts.extensions.get::<Self>().cloned();
        caller.ok_or_else(|| Problem::internal("a request without a caller"))
    }
}

/// Passes a request on if its token allows it.
pub(super) async fn check(State(gate): State<Gate>, mut request: Request, next: Next) -> Response {
    let address = request.extensions().get::<PeerAddress>();
    let address = address.map_or(Ipv6Addr::UNSPECIFIED.into(), |peer| peer.0);
    if is_open(request.uri().path()) {
        request.extensions_mut().insert(Caller::Anyone(address));
        return next.run(request).await;
    }
    let Some(caller) = gate.caller(address, request.headers()) else {
        return unauthorised();
    };
    let scope = needed(request.method());
    // Whether a job is the caller's own shows once it is found; the name of a terrain is known to those
    // who have its file.
    let may_be_own = scope == Scope::Read && names_one(request.uri().path());
    let allowed = caller.may(scope) || (may_be_own && caller.may(Scope::Submit));
    if !allowed {
        return forbidden(&format!("the token lacks the scope \"{}\"", scope.word()))
            .into_response();
    }
    request.extensions_mut().insert(caller);
    next.run(request).await
}

/// True if the path is open without a token.
pub(super) fn is_open(path: &str) -> bool {
    OPEN.contains(&path) || page::is_page(path) || ogc::is_description(path)
}

fn names_one(path: &str) -> bool {
    ["/v1/jobs/", "/ogc/jobs/", "/v1/terrains/"]
        .iter()
        .any(|all| path.starts_with(all))
}

fn needed(method: &Method) -> Scope {
    if [Method::GET, Method::HEAD, Method::OPTIONS].contains(method) {
        Scope::Read
    } else {
        Scope::Submit
    }
}

fn bearer(headers: &HeaderMap) -> Option<&str> {
    let text = headers.get(header::AUTHORIZATION)?.to_str().ok()?;
    let (scheme, token) = text.split_once(' ')?;
    scheme.eq_ignore_ascii_case("bearer").then(|| token.trim())
}

fn unauthorised() -> Response {
    let problem = Problem::new(
        StatusCode::UNAUTHORIZED,
        "no-token",
        "No good access token",
        "the request needs the header Authorization: Bearer TOKEN with a token of this service",
    );
    let mut response = problem.into_response();
    let challenge = HeaderValue::from_static("Bearer");
    response
        .headers_mut()
        .insert(header::WWW_AUTHENTICATE, challenge);
    response
}

fn forbidden(detail: &str) -> Problem {
    Problem::new(
        StatusCode::FORBIDDEN,
        "not-allowed",
        "Not allowed with this token",
        detail,
    )
}
