//! Metrics of the service, in the text format of Prometheus (OpenMetrics).

use super::problem::Problem;
use crate::jobs::JobService;
use crate::jobs::store::JobCounts;
use axum::Extension;
use axum::extract::{Request, State};
use axum::http::header;
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use prometheus_client::encoding::text::encode;
use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::family::Family;
use prometheus_client::metrics::gauge::Gauge;
use prometheus_client::metrics::histogram::Histogram;
use prometheus_client::registry::{Registry, Unit};
use std::sync::atomic::AtomicU64;
use std::time::Instant;

/// Upper bounds of the response-time classes [s].
const CLASSES_S: [f64; 6] = [0.001, 0.01, 0.05, 0.2, 1.0, 10.0];

/// Media type of the answer.
const MEDIA_TYPE: &str = "application/openmetrics-text; version=1.0.0; charset=utf-8";

/// One label of a metric: its name and value.
type Label = [(&'static str, String); 1];

/// Gauge of a real number.
type RealGauge = Gauge<f64, AtomicU64>;

/// Counts of requests since the start.
#[derive(Debug, Clone)]
pub(super) struct RequestCounts {
    by_status: Family<Label, Counter>,
    seconds: Histogram,
}

impl Default for RequestCounts {
    fn default() -> Self {
        Self {
            by_status: Family::default(),
            seconds: Histogram::new(CLASSES_S),
        }
    }
}

/// Counts a request and the time until the head of its answer.
pub(super) async fn count(
    Extension(counts): Extension<RequestCounts>,
    request: Request,
    next: Next,
) -> Response {
    let began = Instant::now();
    let response = next.run(request).await;
    counts.take_in(response.status().as_u16(), began.elapsed().as_secs_f64());
    response
}

/// Read the metrics
///
/// In the text format of Prometheus.
#[utoipa::path(
    get,
    path = "/metrics",
    tag = "service",
    responses(
        (status = 200, description = "The metrics", body = String, content_type = "application/openmetrics-text"),
        (status = 503, description = "The database does not answer", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn metrics(
    State(jobs): State<JobService>,
    Extension(counts): Extension<RequestCounts>,
) -> Result<Response, Problem> {
    let mut registry = Registry::with_prefix("scree");
    match &*jobs.count_jobs().await {
        Ok(counts) => register_jobs(&mut registry, counts),
        Err(error) => return Err(error.into()),
    }
    counts.register(&mut registry);
    let mut text = String::new();
    encode(&mut text, &registry).map_err(|error| Problem::internal(&error))?;
    Ok(([(header::CONTENT_TYPE, MEDIA_TYPE)], text).into_response())
}

/// Registers what the database counts.
fn register_jobs(registry: &mut Registry, counts: &JobCounts) {
    let jobs = Family::<Label, Gauge>::default();
    for (status, count) in &counts.jobs {
        let label = [("status", status.word().to_owned())];
        jobs.get_or_create(&label).set(*count as i64);
    }
    registry.register("jobs", "Jobs by state", jobs);
    let attempts = Family::<Label, Counter>::default();
    for (ending, count) in &counts.attempts {
        attempts
            .get_or_create(&[("ending", ending.clone())])
            .inc_by(*count);
    }
    let help = "Ended attempts at jobs, by how they ended";
    registry.register("attempts_ended", help, attempts);
    let waiting = RealGauge::default();
    waiting.set(counts.oldest_waiting_s);
    let help = "Age of the oldest waiting job";
    registry.register_with_unit("oldest_waiting", help, Unit::Seconds, waiting);
    let database: Gauge = Gauge::default();
    database.set(counts.database_bytes as i64);
    let help = "Length of the database";
    registry.register_with_unit("database", help, Unit::Bytes, database);
}

impl RequestCounts {
    fn take_in(&self, status: u16, time_s: f64) {
        let class = format!("{}xx", (status / 100).clamp(1, 5));
        self.by_status.get_or_create(&[("status", class)]).inc();
        self.seconds.observe(time_s);
    }

    fn register(self, registry: &mut Registry) {
        let help = "Answered requests by class of status";
        registry.register("requests", help, self.by_status);
        let help = "Time to the head of an answer";
        registry.register_with_unit("request", help, Unit::Seconds, self.seconds);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn requests_are_counted_by_status_and_time() {
        let counts = RequestCounts::default();
        counts.take_in(200, 0.005);
        counts.take_in(202, 0.5);
        counts.take_in(503, 100.0);
        let mut registry = Registry::with_prefix("scree");
        counts.register(&mut registry);
        let mut text = String::new();
        encode(&mut text, &registry).unwrap();
        for line in [
            "scree_requests_total{status=\"2xx\"} 2",
            "scree_requests_total{status=\"5xx\"} 1",
            "scree_request_seconds_bucket{le=\"0.001\"} 0",
            "scree_request_seconds_bucket{le=\"0.01\"} 1",
            "scree_request_seconds_bucket{le=\"1.0\"} 2",
            "scree_request_seconds_bucket{le=\"+Inf\"} 3",
            "scree_request_seconds_sum 100.505",
            "scree_request_seconds_count 3",
        ] {
            assert!(text.lines().any(|found| found == line), "{line}\n{text}");
        }
    }
}
