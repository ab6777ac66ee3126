//! A job of the service.

use super::answer::{text, understood};
use super::transport::{LONGEST_WAIT_S, Transport};
use crate::cli::arguments::Quiet;
use crate::cli::failure::Failure;
use crate::cli::job_document::Job;
use crate::cli::{intervals, table};
use scree_solver::record::Outcome;
use uuid::Uuid;

/// A job as received.
pub(super) struct ReceivedJob {
    pub(super) document: Job,
    /// The whole document, as it came.
    pub(super) text: String,
}

impl ReceivedJob {
    /// A job from an answer.
    ///
    /// # Errors
    /// The answer is no job.
    pub(super) fn read(answer: Vec<u8>) -> Result<Self, Failure> {
        let text = text(answer)?;
        let document = understood(&text)?;
        Ok(Self { document, text })
    }

    /// The outcome; the failure names the job.
    ///
    /// # Errors
    /// The job gave none.
    pub(super) fn outcome(&self) -> Result<Outcome, Failure> {
        self.document
            .end()
            .map_err(|failure| failure.of(&format!("job {}", self.document.id)))
    }
}

/// Path of a job.
pub(super) fn path(id: &Uuid) -> String {
    format!("/v1/jobs/{id}")
}

/// The job with this identifier; none if there is no such job.
///
/// # Errors
/// No answer, or another refusal.
pub(super) fn find(transport: &Transport, id: &Uuid) -> Result<Option<ReceivedJob>, Failure> {
    let answer = transport.get_if_there(&path(id))?;
    answer.map(ReceivedJob::read).transpose()
}

/// Shows the progress of a job until it has ended.
///
/// # Errors
/// No answer for too long, or a refusal.
pub(super) fn follow(
    transport: &Transport,
    id: &Uuid,
    quiet: Quiet,
) -> Result<ReceivedJob, Failure> {
    let mut meter = quiet.meter();
    // Progress comes about once a second.
    let wait_s = if meter.is_silent() { LONGEST_WAIT_S } else { 1 };
    let path = format!("{}?wait={wait_s}s", path(id));
    let ended = loop {
        let received = transport.get(&path).map_err(Failure::from);
        let job = match received.and_then(ReceivedJob::read) {
            Ok(job) => job,
            Err(failure) => break Err(failure),
        };
        meter.show(&job.document.progress);
        if job.document.has_ended() {
            break Ok(job);
        }
    };
    meter.finish();
    ended
}

/// The outcome as `scree run` prints it.
pub(super) fn in_words(outcome: &Outcome) -> String {
    match intervals::intervals(outcome) {
        Some(intervals) => format!("{}\n{intervals}", table::outcome(outcome)),
        None => table::outcome(outcome),
    }
}

/// Progress of a job that has not ended.
pub(super) fn progress_in_words(job: &Job) -> String {
    match job.status.as_str() {
        "accepted" => "waits for a worker".to_owned(),
        _ => format!(
            "{}, {:.0} % done, t = {:.3} s",
            job.status,
            (100.0 * job.progress.fraction).floor(),
            job.progress.simulated_time_s
        ),
    }
}

/// Failure for an identifier that the service does not know.
pub(super) fn unknown(transport: &Transport, id: &Uuid) -> Failure {
    Failure::Input(format!("{} has no job or study {id}", transport.address()))
}
