//! The stream of events: every change of a job's state, as it happens or once
//! more for who was away.

use super::problem::Problem;
use super::query::Query;
use crate::jobs::Jobs;
use crate::jobs::job::JobId;
use crate::jobs::store::Event;
use axum::body::{Body, Bytes};
use axum::extract::{RawQuery, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use futures_util::stream;
use std::convert::Infallible;
use std::time::Duration;
use tokio::time::{Instant, sleep};

/// Between two looks for news.
const LOOK_PAUSE: Duration = Duration::from_millis(200);

/// After so long without news a comment shows both ends that the other is there.
const LONGEST_SILENCE: Duration = Duration::from_secs(10);

/// Follow jobs
///
/// Server-sent events, one for each change of a job's state: `event: status`,
/// `id:` its number, `data:` an object with `id`, `status` and `attempt`. With
/// `Last-Event-ID` (or `after`) it begins with what came after that event;
/// without, events of one job come from its first, those of all from now on. The
/// stream of one job ends with the job.
#[utoipa::path(
    get,
    path = "/v1/events",
    tag = "jobs",
    params(
        ("job" = Option<String>, Query, description = "Only events of this job"),
        ("after" = Option<u32>, Query, description = "Only events after this number"),
        ("Last-Event-ID" = Option<String>, Header, description = "The same; wins over `after`"),
    ),
    responses(
        (status = 200, description = "The events", body = String, content_type = "text/event-stream"),
        (status = 204, description = "The job has ended, and nothing is to be told any more"),
        (status = 404, description = "There is no such job", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "A parameter is not allowed", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn events(
    State(jobs): State<Jobs>,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::new(query.as_deref());
    let job: Option<JobId> = query.word("job", "a job's id", |text| text.parse().ok());
    let after = query.whole("after", 0..=u32::MAX).map(i64::from);
    query.finish()?;
    let last = headers.get("last-event-id");
    let last = last.and_then(|id| id.to_str().ok()?.parse().ok());
    let after = match (last.or(after), job) {
        (Some(after), _) => after,
        (None, Some(_)) => 0,
        (None, None) => jobs.last_event().await?,
    };
    let first = jobs.events(after, job).await?;
    if let Some(id) = job {
        let status = jobs.status(id).await?;
        let status = status.ok_or_else(|| super::jobs::unknown_job(&id.to_string()))?;
        if first.is_empty() && status.is_final() {
            return Ok(StatusCode::NO_CONTENT.into_response());
        }
    }
    let follower = Follower {
        jobs,
        job,
        after,
        ready: first,
        spoke: Instant::now(),
    };
    let pieces = stream::unfold(follower, |follower| async {
        let (text, follower) = follower.next().await?;
        Some((Ok::<_, Infallible>(Bytes::from(text)), follower))
    });
    let kind = [
        (header::CONTENT_TYPE, "text/event-stream"),
        (header::CACHE_CONTROL, "no-store"),
    ];
    Ok((kind, Body::from_stream(pieces)).into_response())
}

/// One client's place in the stream.
struct Follower {
    jobs: Jobs,
    job: Option<JobId>,
    after: i64,
    ready: Vec<Event>,
    spoke: Instant,
}

impl Follower {
    /// The next piece of text; none at the stream's end.
    async fn next(mut self) -> Option<(String, Self)> {
        loop {
            if let Some(last) = self.ready.last() {
                self.after = last.sequence;
                let text = self.ready.drain(..).map(|event| text(&event)).collect();
                self.spoke = Instant::now();
                return Some((text, self));
            }
            if self.jobs.is_closing() || self.has_ended().await? {
                return None;
            }
            if self.spoke.elapsed() > LONGEST_SILENCE {
                self.spoke = Instant::now();
                return Some((":\n\n".to_owned(), self));
            }
            sleep(LOOK_PAUSE).await;
            self.ready = self.jobs.events(self.after, self.job).await.ok()?;
        }
    }

    /// True if the one job that is followed has ended and all is told. No answer
    /// if the database does not give one.
    async fn has_ended(&mut self) -> Option<bool> {
        let Some(job) = self.job else {
            return Some(false);
        };
        let status = self.jobs.status(job).await.ok()?;
        let ended = status.is_none_or(|status| status.is_final());
        // What came between the last look and this one is still to be told.
        self.ready = self.jobs.events(self.after, self.job).await.ok()?;
        Some(ended && self.ready.is_empty())
    }
}

fn text(event: &Event) -> String {
    format!(
        "id: {}\nevent: status\ndata: {{\"id\":\"{}\",\"status\":\"{}\",\"attempt\":{}}}\n\n",
        event.sequence,
        event.job,
        event.status.word(),
        event.attempt
    )
}
