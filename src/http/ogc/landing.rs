//! Landing page, and the classes of the standard that the service conforms to.

use super::links::{Base, Link, relation};
use axum::Json;
use serde::Serialize;
use utoipa::ToSchema;

/// Media type of the contract.
const OPENAPI: &str = "application/vnd.oai.openapi+json;version=3.1";

/// Classes of OGC API – Processes, Part 1, that the service conforms to.
const CLASSES: [&str; 4] = [
    "http://www.opengis.net/spec/ogcapi-processes-1/1.0/conf/core",
    "http://www.opengis.net/spec/ogcapi-processes-1/1.0/conf/ogc-process-description",
    "http://www.opengis.net/spec/ogcapi-processes-1/1.0/conf/json",
    "http://www.opengis.net/spec/ogcapi-processes-1/1.0/conf/dismiss",
];

/// Landing page of OGC API – Processes.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = LandingPage)]
pub(super) struct LandingPageDocument {
    /// Name of the service.
    title: &'static str,
    /// Purpose of the service.
    description: &'static str,
    /// Links to its resources.
    links: Vec<Link>,
}

/// Conformance classes.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Conformance)]
pub(super) struct ConformanceDocument {
    /// Their URIs.
    #[serde(rename = "conformsTo")]
    conforms_to: [&'static str; CLASSES.len()],
}

/// Get the landing page
///
/// It links to everything else.
#[utoipa::path(
    get,
    path = "/ogc",
    tag = super::TAG,
    responses((status = 200, description = "The landing page", body = LandingPageDocument)),
)]
pub(super) async fn landing_page(base: Base) -> Json<LandingPageDocument> {
    let contract = Link {
        media_type: OPENAPI,
        ..base.json("/openapi.json", "service-desc", "Contract of the service")
    };
    let page = Link {
        media_type: "text/html",
        ..base.json("/", "service-doc", "Interface of the service as a page")
    };
    let conformance = "Conformance classes";
    Json(LandingPageDocument {
        title: "Scree",
        description: "Where does an object hit by a granular flow end up?",
        links: vec![
            base.json("/ogc", "self", "This page"),
            contract,
            page,
            base.json("/ogc/conformance", "conformance", conformance),
            base.json("/ogc/conformance", relation::CONFORMANCE, conformance),
            base.json("/ogc/processes", relation::PROCESSES, "Processes"),
            base.json("/ogc/jobs", relation::JOB_LIST, "Jobs"),
        ],
    })
}

/// Get the conformance classes
///
/// Those of OGC API – Processes, Part 1: Core, version 1.0. The class core is met but for inputs by
/// reference, `multipart/related`, and a choice of outputs in asynchronous results.
#[utoipa::path(
    get,
    path = "/ogc/conformance",
    tag = super::TAG,
    responses((status = 200, description = "The classes", body = ConformanceDocument)),
)]
pub(super) async fn conformance() -> Json<ConformanceDocument> {
    Json(ConformanceDocument {
        conforms_to: CLASSES,
    })
}
