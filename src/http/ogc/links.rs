//! Links to the resources of the service, with the address under which it was asked.

use axum::extract::FromRequestParts;
use axum::http::request::Parts;
use axum::http::{HeaderMap, HeaderValue, header};
use serde::Serialize;
use std::convert::Infallible;
use std::fmt::Display;
use utoipa::ToSchema;

/// Media type of JSON.
pub(super) const JSON: &str = "application/json";

/// Link to a resource.
#[derive(Debug, Serialize, ToSchema)]
pub(super) struct Link {
    /// Its address.
    pub href: String,
    /// Relation to the document that has the link.
    pub rel: &'static str,
    /// Media type of the resource.
    #[serde(rename = "type")]
    pub media_type: &'static str,
    /// Name for people.
    pub title: &'static str,
}

/// Relations registered by OGC.
pub(super) mod relation {
    pub(crate) const CONFORMANCE: &str = "http://www.opengis.net/def/rel/ogc/1.0/conformance";
    pub(crate) const EXCEPTIONS: &str = "http://www.opengis.net/def/rel/ogc/1.0/exceptions";
    pub(crate) const EXECUTE: &str = "http://www.opengis.net/def/rel/ogc/1.0/execute";
    pub(crate) const JOB_LIST: &str = "http://www.opengis.net/def/rel/ogc/1.0/job-list";
    pub(crate) const PROCESSES: &str = "http://www.opengis.net/def/rel/ogc/1.0/processes";
    pub(crate) const RESULTS: &str = "http://www.opengis.net/def/rel/ogc/1.0/results";
}

/// Scheme and authority of the service as its client wrote them; empty for a client of HTTP/1.0
/// without `Host`, whose links begin with the path.
#[derive(Debug, Clone)]
pub(super) struct Base(String);

impl Base {
    fn of(headers: &HeaderMap) -> Self {
        // Checked before: it is a name or address, and perhaps a port.
        let host = headers
            .get(header::HOST)
            .and_then(|host| host.to_str().ok());
        // A proxy in front of the service speaks https for it.
        let forwarded = headers.get("x-forwarded-proto").map(HeaderValue::as_bytes);
        let scheme = match forwarded {
            Some(b"https") => "https",
            _ => "http",
        };
        Self(host.map_or_else(String::new, |host| format!("{scheme}://{host}")))
    }

    /// Address of the resource at this path.
    pub(super) fn at(&self, path: impl Display) -> String {
        format!("{}{path}", self.0)
    }

    /// Link to the JSON at this path.
    pub(super) fn json(&self, path: impl Display, rel: &'static str, title: &'static str) -> Link {
        Link {
            href: self.at(path),
            rel,
            media_type: JSON,
            title,
        }
    }
}

impl<S: Send + Sync> FromRequestParts<S> for Base {
    type Rejection = Infallible;

    async fn from_request_parts(parts: &mut Parts, _state: &S) -> Result<Self, Infallible> {
        Ok(Self::of(&parts.headers))
    }
}

/// A link as the header `Link` has it (RFC 8288).
pub(super) fn header_value(href: &str, rel: &str) -> Option<HeaderValue> {
    HeaderValue::try_from(format!("<{href}>; rel=\"{rel}\"")).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_have_the_address_that_the_client_used() {
        let base = |headers: &[(&'static str, &str)]| {
            let headers = headers.iter().map(|(name, value)| {
                let name = header::HeaderName::from_static(name);
                (name, HeaderValue::from_str(value).unwrap())
            });
            Base::of(&headers.collect()).at("/ogc")
        };
        let host = ("host", "lab.example:81");
        assert_eq!(base(&[host]), "http://lab.example:81/ogc");
        let proxied = base(&[host, ("x-forwarded-proto", "https")]);
        assert_eq!(proxied, "https://lab.example:81/ogc");
        let odd = base(&[host, ("x-forwarded-proto", "javascript")]);
        assert_eq!(odd, "http://lab.example:81/ogc");
        assert_eq!(base(&[]), "/ogc");
    }
}
