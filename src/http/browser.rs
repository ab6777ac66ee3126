//! Protection of people who have a browser open beside the service: a page elsewhere must not
//! speak to the service in their name, and what the service answers must not be run as a page.

use super::problem::Problem;
use crate::config::ServiceConfig;
use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderName, HeaderValue, Method, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use std::net::IpAddr;
use std::sync::Arc;
use tower_http::cors::CorsLayer;

/// Policy of every answer but the page of the interface: nothing is loaded, and nobody frames it.
const NOTHING: HeaderValue = HeaderValue::from_static("default-src 'none'; frame-ancestors 'none'");
/// Policy of the page of the interface: its own script, style and requests.
const OWN: HeaderValue = HeaderValue::from_static(
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; \
     base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
);
const NOSNIFF: HeaderValue = HeaderValue::from_static("nosniff");

/// Names of the service, and pages that may use it.
#[derive(Debug, Clone)]
pub(super) struct Doors {
    /// Names it may be addressed by besides addresses of the loopback interface; `None`: any.
    hosts: Option<Arc<[String]>>,
    origins: Arc<[String]>,
}

impl Doors {
    pub(super) fn new(config: &ServiceConfig) -> Self {
        let listed = &config.browser.hosts;
        // With tokens a foreign page has nothing to show, whatever name it uses.
        let any = !config.tokens.is_empty() && listed.is_empty();
        let own = std::iter::once(config.listen.ip().to_string());
        let hosts = own.chain(listed.iter().map(|host| host.to_ascii_lowercase()));
        Self {
            hosts: (!any).then(|| hosts.collect()),
            origins: config.browser.origins.iter().cloned().collect(),
        }
    }

    /// Reason for refusing a request.
    fn refusal(&self, headers: &HeaderMap) -> Option<Problem> {
        let text = |name: HeaderName| headers.get(name).map(|value| value.to_str().unwrap_or(""));
        let host = text(header::HOST);
        if let (Some(hosts), Some(host)) = (&self.hosts, host)
            && !is_own(name_of(host), hosts)
        {
            return Some(foreign(
                "foreign-host",
                "Not a name of this service",
                format!(
                    "the request is for {host:?}, which is no name of this service: \
                     browser.hosts in its configuration lists further ones"
                ),
            ));
        }
        let origin = text(header::ORIGIN)?;
        let same = |host: &str| {
            let of_scheme = |scheme: &str| origin.strip_prefix(scheme) == Some(host);
            of_scheme("http://") || of_scheme("https://")
        };
        if host.is_some_and(same) || self.origins.iter().any(|allowed| allowed == origin) {
            return None;
        }
        Some(foreign(
            "foreign-origin",
            "Not a page that may use this service",
            format!(
                "the request comes from a page of {origin:?}: browser.origins in the \
                 configuration lists the pages that may use the service"
            ),
        ))
    }
}

/// True for a name or address of the loopback interface, or one that is listed.
fn is_own(name: &str, listed: &[String]) -> bool {
    let name = name.trim_end_matches('.').to_ascii_lowercase();
    let address: Option<IpAddr> = name.trim_matches(['[', ']']).parse().ok();
    name == "localhost"
        || address.is_some_and(|address| address.is_loopback())
        || address.is_some_and(|address| listed.contains(&address.to_string()))
        || listed.contains(&name)
}

/// A host without its port.
fn name_of(host: &str) -> &str {
    match host.rsplit_once(':') {
        Some((name, port)) if port.bytes().all(|byte| byte.is_ascii_digit()) => name,
        _ => host,
    }
}

fn foreign(kind: &str, title: &'static str, detail: String) -> Problem {
    Problem::new(StatusCode::FORBIDDEN, kind, title, detail)
}

/// Refuses requests for other names and from foreign pages.
pub(super) async fn check(State(doors): State<Doors>, request: Request, next: Next) -> Response {
    match doors.refusal(request.headers()) {
        Some(problem) => problem.into_response(),
        None => next.run(request).await,
    }
}

/// Adds the headers that keep an answer from being taken for something else.
pub(super) async fn harden(request: Request, next: Next) -> Response {
    let is_page = request.uri().path() == "/";
    let mut response = next.run(request).await;
    let policy = if is_page { OWN } else { NOTHING };
    let headers = response.headers_mut();
    headers.insert(header::X_CONTENT_TYPE_OPTIONS, NOSNIFF);
    headers.insert(header::CONTENT_SECURITY_POLICY, policy);
    response
}

/// Permissions of pages of the listed origins (CORS); `None` if there are none.
pub(super) fn cors(config: &ServiceConfig) -> Option<CorsLayer> {
    let origins = config.browser.origins.iter();
    let origins: Vec<HeaderValue> = origins.filter_map(|origin| origin.parse().ok()).collect();
    (!origins.is_empty()).then(|| allowing(origins))
}

fn allowing(origins: Vec<HeaderValue>) -> CorsLayer {
    CorsLayer::new()
        .allow_origin(origins)
        .allow_methods([Method::GET, Method::POST, Method::DELETE])
        .allow_headers([
            header::AUTHORIZATION,
            header::CONTENT_TYPE,
            header::IF_NONE_MATCH,
            HeaderName::from_static("idempotency-key"),
            HeaderName::from_static("last-event-id"),
        ])
        .expose_headers([
            header::ETAG,
            header::LOCATION,
            header::RETRY_AFTER,
            HeaderName::from_static("x-request-id"),
        ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_host_is_told_from_its_port() {
        for (host, name) in [
            ("localhost:8080", "localhost"),
            ("[::1]:8080", "[::1]"),
            ("[::1]", "[::1]"),
            ("scree.lab", "scree.lab"),
        ] {
            assert_eq!(name_of(host), name);
        }
    }

    #[test]
    fn the_loopback_interface_and_what_is_listed_are_own() {
        let listed = ["scree.lab".to_owned(), "192.0.2.7".to_owned()];
        for own in ["127.0.0.1", "127.8.0.1", "[::1]", "LocalHost", "localhost."] {
            assert!(is_own(own, &[]), "{own}");
        }
        for own in ["Scree.Lab", "192.0.2.7"] {
            assert!(is_own(own, &listed), "{own}");
        }
        for foreign in [
            "attacker.example",
            "localhost.attacker.example",
            "",
            "0.0.0.0",
            "x",
        ] {
            assert!(!is_own(foreign, &listed), "{foreign}");
        }
    }
}
