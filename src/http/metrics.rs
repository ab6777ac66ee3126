//! Metrics of the service, in the text format of Prometheus.

use super::problem::Problem;
use crate::jobs::JobService;
use axum::Extension;
use axum::extract::{Request, State};
use axum::http::header;
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use std::fmt::Write as _;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

/// Upper bounds of the response-time classes [s].
const CLASSES_S: [f64; 6] = [0.001, 0.01, 0.1, 1.0, 10.0, f64::INFINITY];

/// Counts of requests since the start.
#[derive(Debug, Default)]
pub(super) struct RequestCounts {
    /// By the first digit of the status, 1 to 5.
    by_status: [AtomicU64; 5],
    by_time: [AtomicU64; CLASSES_S.len()],
    microseconds: AtomicU64,
}

/// Counts a request and the time until the head of its answer.
pub(super) async fn count(
    Extension(counts): Extension<Arc<RequestCounts>>,
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
        (status = 200, description = "The metrics", body = String, content_type = "text/plain"),
        (status = 503, description = "The database does not answer", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn metrics(
    State(jobs): State<JobService>,
    Extension(counts): Extension<Arc<RequestCounts>>,
) -> Result<Response, Problem> {
    let count_jobs = jobs.count_jobs().await?;
    let mut text = String::new();
    let mut family = |name: &str, kind: &str, help: &str, rows: &[(String, f64)]| {
        // Writing into a string can't fail.
        let _ = writeln!(
            text,
            "# HELP scree_{name} {help}\n# TYPE scree_{name} {kind}"
        );
        for (labels, value) in rows {
            let _ = writeln!(text, "scree_{name}{labels} {value}");
        }
    };
    let plain = |value: f64| [(String::new(), value)];
    let jobs_rows = count_jobs
        .jobs
        .map(|(status, count)| (format!("{{status=\"{}\"}}", status.word()), count as f64));
    family("jobs", "gauge", "Jobs by state.", &jobs_rows);
    let attempts: Vec<_> = count_jobs
        .attempts
        .iter()
        .map(|(ending, count)| (format!("{{ending=\"{ending}\"}}"), *count as f64))
        .collect();
    family(
        "attempts_ended_total",
        "counter",
        "Ended attempts at jobs that are kept, by how they ended.",
        &attempts,
    );
    family(
        "oldest_waiting_seconds",
        "gauge",
        "Age of the oldest waiting job.",
        &plain(count_jobs.oldest_waiting_s),
    );
    family(
        "database_bytes",
        "gauge",
        "Length of the database.",
        &plain(count_jobs.database_bytes as f64),
    );
    family(
        "requests_total",
        "counter",
        "Answered requests by class of status.",
        &counts.statuses(),
    );
    family(
        "request_seconds",
        "histogram",
        "Time to the head of an answer.",
        &[],
    );
    text.push_str(&counts.histogram());
    Ok(([(header::CONTENT_TYPE, "text/plain; version=0.0.4")], text).into_response())
}

impl RequestCounts {
    fn take_in(&self, status: u16, time_s: f64) {
        let class = usize::from(status / 100).clamp(1, 5) - 1;
        self.by_status[class].fetch_add(1, Ordering::Relaxed);
        let place = CLASSES_S.iter().position(|end| time_s <= *end);
        self.by_time[place.unwrap_or(CLASSES_S.len() - 1)].fetch_add(1, Ordering::Relaxed);
        self.microseconds
            .fetch_add((time_s * 1e6) as u64, Ordering::Relaxed);
    }

    fn statuses(&self) -> Vec<(String, f64)> {
        let classes = self.by_status.iter().enumerate();
        classes
            .map(|(place, count)| {
                let count = count.load(Ordering::Relaxed) as f64;
                (format!("{{status=\"{}xx\"}}", place + 1), count)
            })
            .collect()
    }

    fn histogram(&self) -> String {
        let mut text = String::new();
        let mut sum = 0;
        for (end, count) in CLASSES_S.iter().zip(&self.by_time) {
            sum += count.load(Ordering::Relaxed);
            let end = if end.is_finite() {
                end.to_string()
            } else {
                "+Inf".to_owned()
            };
            let _ = writeln!(text, "scree_request_seconds_bucket{{le=\"{end}\"}} {sum}");
        }
        let seconds = self.microseconds.load(Ordering::Relaxed) as f64 * 1e-6;
        let _ = writeln!(
            text,
            "scree_request_seconds_sum {seconds}\nscree_request_seconds_count {sum}"
        );
        text
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
        let statuses: Vec<f64> = counts.statuses().into_iter().map(|row| row.1).collect();
        assert_eq!(statuses, [0.0, 2.0, 0.0, 0.0, 1.0]);
        let text = counts.histogram();
        for line in [
            "scree_request_seconds_bucket{le=\"0.001\"} 0",
            "scree_request_seconds_bucket{le=\"0.01\"} 1",
            "scree_request_seconds_bucket{le=\"1\"} 2",
            "scree_request_seconds_bucket{le=\"+Inf\"} 3",
            "scree_request_seconds_sum 100.505",
            "scree_request_seconds_count 3",
        ] {
            assert!(text.lines().any(|found| found == line), "{line}\n{text}");
        }
    }
}
