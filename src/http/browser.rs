//! Protection of people who have a browser open beside the service: a page elsewhere must not
//! speak to the service in their name, and what the service answers must not be run as a page.

use super::page;
use super::problem::Problem;
use crate::config::{Authority, Host, Origin, ServiceConfig};
use axum::extract::{Request, State};
use axum::http::{HeaderName, HeaderValue, Method, StatusCode, Version, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use std::sync::Arc;
use tower_http::cors::CorsLayer;

/// Policy of every answer but the page for people: nothing is loaded, and nobody frames it.
const NOTHING: HeaderValue = HeaderValue::from_static("default-src 'none'; frame-ancestors 'none'");
/// Policy of the page for people: its own scripts, styles, pictures and requests. The script of a
/// shared worker has the policy with which it is itself answered.
const OWN: HeaderValue = HeaderValue::from_static(
    "default-src 'none'; script-src 'self'; worker-src 'self'; style-src 'self'; \
     img-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'none'; \
     frame-ancestors 'none'",
);
const NOSNIFF: HeaderValue = HeaderValue::from_static("nosniff");

/// Names of the service, and pages that may use it.
#[derive(Debug, Clone)]
pub(super) struct Doors {
    /// Names it may be addressed by besides addresses of the loopback interface; `None`: any.
    hosts: Option<Arc<[Host]>>,
    origins: Arc<[Origin]>,
}

impl Doors {
    pub(super) fn new(config: &ServiceConfig) -> Self {
        let listed = &config.browser.hosts;
        // With tokens a foreign page has nothing to show, whatever name it uses.
        let any = !config.tokens.is_empty() && listed.is_empty();
        let own = std::iter::once(Host::of_address(config.listen.ip()));
        let hosts = own.chain(listed.iter().filter_map(|host| Host::parse(host)));
        Self {
            hosts: (!any).then(|| hosts.collect()),
            origins: origins(config).collect(),
        }
    }

    /// Reason for refusing a request.
    fn refusal(&self, request: &Request) -> Option<Problem> {
        let hosts = match hosts(request) {
            Ok(hosts) => hosts,
            Err(problem) => return Some(problem),
        };
        if let Some(own) = &self.hosts
            && let Some(foreign) = hosts.iter().find(|host| !is_own(&host.host, own))
        {
            return Some(foreign_host(&foreign.host));
        }
        let mut origins = request.headers().get_all(header::ORIGIN).iter();
        let all_own = origins.all(|origin| {
            let origin = origin.to_str().ok().and_then(Origin::parse);
            origin.is_some_and(|origin| {
                hosts.iter().any(|host| origin.is_of(host)) || self.origins.contains(&origin)
            })
        });
        (!all_own).then(|| {
            foreign(
                "foreign-origin",
                "Not a page that may use this service",
                "the request comes from a page of another origin: browser.origins in the \
                 configuration lists the pages that may use the service"
                    .to_owned(),
            )
        })
    }
}

/// All hosts that a request names: its target, if that is absolute, and its header `Host`, which
/// from HTTP/1.1 on it must have once.
fn hosts(request: &Request) -> Result<Vec<Authority>, Problem> {
    let malformed = |detail: &str| {
        let status = StatusCode::BAD_REQUEST;
        Problem::new(status, "malformed-host", "Malformed Host", detail)
    };
    let headers: Vec<_> = request.headers().get_all(header::HOST).iter().collect();
    let needed = request.version() != Version::HTTP_10;
    if headers.len() > 1 || (headers.is_empty() && needed) {
        return Err(malformed("the request needs the header Host once"));
    }
    let target = request.uri().authority().map(|target| target.as_str());
    let named = headers.iter().map(|host| host.to_str().unwrap_or_default());
    target
        .into_iter()
        .chain(named)
        .map(|host| {
            let detail = "the header Host is a name or an address, and perhaps a port";
            Authority::parse(host).ok_or_else(|| malformed(detail))
        })
        .collect()
}

/// True for a name or address of the loopback interface, or one that is listed.
fn is_own(host: &Host, listed: &[Host]) -> bool {
    host.is_loopback() || listed.contains(host)
}

/// The listed pages elsewhere.
fn origins(config: &ServiceConfig) -> impl Iterator<Item = Origin> {
    let listed = config.browser.origins.iter();
    listed.filter_map(|origin| Origin::parse(origin))
}

fn foreign_host(host: &Host) -> Problem {
    foreign(
        "foreign-host",
        "Not a name of this service",
        format!(
            "the request is for {:?}, which is no name of this service: browser.hosts in its \
             configuration lists further ones",
            host.to_string()
        ),
    )
}

fn foreign(kind: &str, title: &'static str, detail: String) -> Problem {
    Problem::new(StatusCode::FORBIDDEN, kind, title, detail)
}

/// Refuses requests for other names and from foreign pages.
pub(super) async fn check(State(doors): State<Doors>, request: Request, next: Next) -> Response {
    match doors.refusal(&request) {
        Some(problem) => problem.into_response(),
        None => next.run(request).await,
    }
}

/// Adds the headers that keep an answer from being taken for something else.
pub(super) async fn harden(request: Request, next: Next) -> Response {
    let is_page = page::is_page(request.uri().path());
    let mut response = next.run(request).await;
    let policy = if is_page { OWN } else { NOTHING };
    let headers = response.headers_mut();
    headers.insert(header::X_CONTENT_TYPE_OPTIONS, NOSNIFF);
    headers.insert(header::CONTENT_SECURITY_POLICY, policy);
    // A job changes: whoever keeps an answer asks again, by its ETag if it has one.
    headers
        .entry(header::CACHE_CONTROL)
        .or_insert(HeaderValue::from_static("no-cache"));
    response
}

/// Permissions of pages of the listed origins (CORS); `None` if there are none.
pub(super) fn cors(config: &ServiceConfig) -> Option<CorsLayer> {
    let origins = origins(config).filter_map(|origin| origin.to_string().parse().ok());
    let origins: Vec<HeaderValue> = origins.collect();
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
    fn the_loopback_interface_and_what_is_listed_are_own() {
        let host = |text: &str| Host::parse(text).unwrap();
        let listed = ["scree.lab", "192.0.2.7"].map(host);
        for own in [
            "127.0.0.1",
            "127.8.0.1",
            "[::1]",
            "[::ffff:127.0.0.1]",
            "localhost.",
        ] {
            assert!(is_own(&host(own), &[]), "{own}");
        }
        for own in ["Scree.Lab", "192.0.2.7"] {
            assert!(is_own(&host(own), &listed), "{own}");
        }
        for foreign in [
            "attacker.example",
            "localhost.attacker.example",
            "0.0.0.0",
            "x",
        ] {
            assert!(!is_own(&host(foreign), &listed), "{foreign}");
        }
    }

    #[test]
    fn a_request_names_one_good_host() {
        let hosts_of = |version: Version, target: &str, headers: &[&str]| {
            let request = Request::builder().version(version).uri(target);
            let add = |request: axum::http::request::Builder, host: &&str| {
                request.header(header::HOST, *host)
            };
            let request = headers.iter().fold(request, add);
            hosts(&request.body(axum::body::Body::empty()).unwrap())
        };
        let new = Version::HTTP_11;
        assert_eq!(hosts_of(new, "/", &["a:1"]).unwrap().len(), 1);
        assert_eq!(hosts_of(new, "http://b/", &["a"]).unwrap().len(), 2);
        assert!(hosts_of(Version::HTTP_10, "/", &[]).unwrap().is_empty());
        for (target, headers) in [
            ("/", [].as_slice()),
            ("/", &["a", "a"]),
            ("/", &["a:99999999"]),
            ("/", &[""]),
            ("http://b/", &[]),
        ] {
            let problem = hosts_of(new, target, headers).unwrap_err();
            assert_eq!(problem.status, 400, "{target} {headers:?}");
        }
    }
}
