//! The stream of events: every change of a job's state, as it happens or replayed
//! for a client that was disconnected.

use super::named_job::unknown_job;
use super::pieces::Pieces;
use super::problem::Problem;
use super::query::Query;
use super::shares::StreamRight;
use crate::jobs::job::{JobId, JobStatus};
use crate::jobs::store::{Change, Event, StoreError};
use crate::jobs::{JobService, News, RunningProgress};
use crate::quota::InUse;
use crate::runs::Progress;
use axum::body::Bytes;
use axum::extract::{RawQuery, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use std::ops::RangeInclusive;
use std::time::Duration;
use tokio::sync::broadcast::Receiver;
use tokio::sync::broadcast::error::RecvError;
use tokio::time::{Instant, timeout_at};

/// Time without an event after which a comment is sent, so that both ends notice a lost connection.
const LONGEST_SILENCE: Duration = Duration::from_secs(10);

/// Time between two reports of the progress of a followed job.
const PROGRESS_PAUSE: Duration = Duration::from_secs(1);

/// Valid event numbers, and 0 for "before the first".
const NUMBERS: RangeInclusive<i64> = 0..=i64::MAX;

/// Follow jobs
///
/// Server-sent events, one for each change of a job's state: `event: status`,
/// `id:` its number, `data:` an object with `id`, `status` and `attempt`. When a job is removed,
/// its events are replaced by one: `event: removed`, `data:` an object with `id` and `attempt`. With
/// `Last-Event-ID` (or `after`) the stream begins after that event; without it, the
/// stream of one job begins with the job's first event and that of all jobs with the next one.
/// The stream of one job ends with the job. While the job runs, its progress is told about once a
/// second: `event: progress`, without an `id`, `data:` an object with `id` and the job's `progress`.
/// With `progress=true` the stream of all jobs tells that of all running jobs. No progress is
/// replayed.
///
/// After a number that no event has had (the database was restored from a backup) the
/// stream begins with `event: reset`, `id: 0`, `data:` an object with `after`, the number
/// received, and `last`, the number of the last event; all events from the first follow.
/// Earlier knowledge of the client may then be wrong.
#[utoipa::path(
    get,
    path = "/v1/events",
    tag = "jobs",
    params(
        ("job" = Option<String>, Query, format = Uuid, description = "Only events of this job"),
        ("after" = Option<i64>, Query, minimum = 0, description = "Only events after this number"),
        ("progress" = Option<bool>, Query, description = "Whether the progress of running jobs is told; unless given, only in the stream of one job"),
        ("Last-Event-ID" = Option<i64>, Header, minimum = 0, description = "The same; wins over `after`"),
    ),
    responses(
        (status = 200, description = "The events", body = String, content_type = "text/event-stream"),
        (status = 204, description = "The job has ended, and nothing is to be told any more"),
        (status = 404, description = "There is no such job, or nothing is left to be told of a removed one", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many streams are open; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "A parameter or `Last-Event-ID` is not allowed", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn events(
    State(jobs): State<JobService>,
    right: StreamRight,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::new(query.as_deref());
    let job: Option<JobId> = query.word("job", "a job's id", |text| text.parse().ok());
    let after = query.whole("after", NUMBERS);
    let progress = query.truth("progress");
    let seen = headers.get("last-event-id").and_then(|number| {
        let text = String::from_utf8_lossy(number.as_bytes());
        query.whole_of("Last-Event-ID", &text, &NUMBERS)
    });
    query.finish()?;
    let place = right.enter()?;
    // Joined before the first look, so that nothing is missed in between.
    let news = jobs.news();
    let start = Start::after(seen.or(after), job, jobs.last_event().await?);
    let first = jobs.events(start.after, job).await?;
    if let Some(id) = job {
        let status = jobs.status(id).await?;
        if status.is_none() && first.is_empty() {
            return Err(unknown_job(&id.to_string()));
        }
        let has_ended = status.is_some_and(JobStatus::is_final);
        if first.is_empty() && start.reset.is_none() && has_ended {
            return Ok(StatusCode::NO_CONTENT.into_response());
        }
    }
    let follower = Follower {
        jobs,
        job,
        after: start.after,
        reset: start.reset,
        is_behind: !first.is_empty(),
        ready: first,
        news,
        has_ended: false,
        progress: progress.unwrap_or(job.is_some()).then(ToldProgress::new),
        told: Instant::now(),
        _place: place,
    };
    let kind = [
        (header::CONTENT_TYPE, "text/event-stream"),
        (header::CACHE_CONTROL, "no-store"),
    ];
    Ok((kind, follower.into_body()).into_response())
}

/// Start of a stream.
struct Start {
    after: i64,
    /// Message to a client whose number no event has had.
    reset: Option<String>,
}

impl Start {
    /// Start of the stream for a client with this last event number, if it has one.
    fn after(number: Option<i64>, job: Option<JobId>, last: i64) -> Self {
        let (after, reset) = match (number, job) {
            (Some(number), _) if number > last => (0, Some(reset(number, last))),
            (Some(number), _) => (number, None),
            (None, Some(_)) => (0, None),
            (None, None) => (last, None),
        };
        Self { after, reset }
    }
}

/// Position of one client in the stream.
struct Follower {
    jobs: JobService,
    job: Option<JobId>,
    after: i64,
    reset: Option<String>,
    /// Events to be sent next.
    ready: Vec<Event>,
    /// True if events from before the news are still to be read.
    is_behind: bool,
    news: Receiver<News>,
    /// True once the end of the followed job is sent.
    has_ended: bool,
    /// Progress as told last, if it is wanted.
    progress: Option<ToldProgress>,
    /// Time of the last piece.
    told: Instant,
    _place: InUse,
}

impl Pieces for Follower {
    const NAME: &'static str = "events";
    type Error = StoreError;

    async fn piece(&mut self) -> Result<Option<Bytes>, StoreError> {
        let piece = self.next().await;
        self.told = Instant::now();
        piece
    }
}

impl Follower {
    /// The next piece of text; none at the end of the stream.
    async fn next(&mut self) -> Result<Option<Bytes>, StoreError> {
        if let Some(reset) = self.reset.take() {
            return Ok(Some(reset.into()));
        }
        loop {
            if let Some(last) = self.ready.last() {
                self.after = last.sequence;
                let final_of =
                    |event: &Event| Some(event.job) == self.job && event.change.is_final();
                self.has_ended |= self.ready.iter().any(final_of);
                let text: String = self.ready.drain(..).map(|event| text(&event)).collect();
                return Ok(Some(text.into()));
            }
            if self.has_ended {
                return Ok(None);
            }
            if self.is_behind {
                self.ready = self.jobs.events(self.after, self.job).await?;
                self.is_behind = !self.ready.is_empty();
                continue;
            }
            let silent = self.told + LONGEST_SILENCE;
            let due = self.progress.as_ref().map(|progress| progress.due);
            let next = due.map_or(silent, |due| silent.min(due));
            match timeout_at(next, self.news.recv()).await {
                Ok(Ok(News::Events(events))) => {
                    let wanted = |event: &&Event| {
                        event.sequence > self.after && self.job.is_none_or(|job| event.job == job)
                    };
                    self.ready = events.iter().filter(wanted).copied().collect();
                }
                Ok(Ok(News::Closing) | Err(RecvError::Closed)) => return Ok(None),
                Ok(Err(RecvError::Lagged(_))) => self.is_behind = true,
                Err(_) => {
                    if let Some(progress) = &mut self.progress
                        && let Some(text) = progress.next(&self.jobs, self.job).await
                    {
                        return Ok(Some(text.into()));
                    }
                    if Instant::now() >= silent {
                        return Ok(Some(Bytes::from_static(b":\n\n")));
                    }
                }
            }
        }
    }
}

/// Progress of the followed jobs, as told last.
struct ToldProgress {
    last: RunningProgress,
    due: Instant,
}

impl ToldProgress {
    fn new() -> Self {
        Self {
            last: RunningProgress::new(),
            due: Instant::now() + PROGRESS_PAUSE,
        }
    }

    /// Events of all that has changed, if they are due.
    async fn next(&mut self, jobs: &JobService, followed: Option<JobId>) -> Option<String> {
        if Instant::now() < self.due {
            return None;
        }
        self.due = Instant::now() + PROGRESS_PAUSE;
        // A database that does not answer now may do so the next time.
        let now: RunningProgress = match followed {
            Some(job) => {
                let progress = jobs.progress_of(job).await.ok()?;
                progress
                    .map(|progress| (job, progress))
                    .into_iter()
                    .collect()
            }
            None => jobs
                .running_progress()
                .await
                .as_ref()
                .as_ref()
                .ok()?
                .clone(),
        };
        let changed = now
            .iter()
            .filter(|(job, progress)| self.last.get(job) != Some(progress));
        let text: String = changed.filter_map(progress_text).collect();
        self.last = now;
        (!text.is_empty()).then_some(text)
    }
}

/// Event of the progress of a job. Without an id: the client goes on after the last change of state.
fn progress_text((job, progress): (&JobId, &Progress)) -> Option<String> {
    let progress = serde_json::to_string(progress).ok()?;
    let data = format!("{{\"id\":\"{job}\",\"progress\":{progress}}}");
    Some(format!("event: progress\ndata: {data}\n\n"))
}

/// With this id, a client that is disconnected right afterwards begins at the first event.
fn reset(after: i64, last: i64) -> String {
    format!("id: 0\nevent: reset\ndata: {{\"after\":{after},\"last\":{last}}}\n\n")
}

fn text(event: &Event) -> String {
    let (kind, status) = match event.change {
        Change::Status(status) => ("status", format!(r#","status":"{}""#, status.word())),
        Change::Removed => ("removed", String::new()),
    };
    let Event {
        sequence,
        job,
        attempt,
        ..
    } = event;
    format!(
        "id: {sequence}\nevent: {kind}\ndata: {{\"id\":\"{job}\"{status},\"attempt\":{attempt}}}\n\n"
    )
}
