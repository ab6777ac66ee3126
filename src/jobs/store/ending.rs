//! Failed attempts, and the rule by which a job waits for the next one or fails.

use crate::jobs::failure::Failure;

/// Number of failed attempts in a row after which a job fails: a job that crashes the
/// service must not do so for ever.
pub const TOLERATED_SETBACKS: u32 = 3;

/// Waiting times of a job after its first, second, … failed attempt [ms], and least uptime of
/// the service before it claims the job again.
pub(super) const BACK_OFF_MS: [i64; 2] = [2_000, 8_000];

/// Cause of the end of an attempt through no fault of the scenario.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FailedAttempt {
    /// The process died.
    CutOff,
    /// The lease ran out.
    Expired,
    /// A resource of the run was missing.
    Infrastructure(String),
}

/// Result of a failed attempt for its job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Returned {
    /// The job waits for another attempt.
    Waiting,
    /// The job failed, after too many failed attempts.
    Failed,
    /// The job no longer belonged to this lease; nothing was changed.
    Lost,
}

/// Consequence of a failed attempt for its job.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Consequence {
    /// The job returns to the queue.
    Waits {
        /// Failed attempts in a row that this one adds.
        failed_attempts: u32,
        /// Time before it may be claimed again [ms].
        wait_ms: i64,
    },
    /// The job fails.
    Fails(Failure),
}

/// Progress of an attempt before it failed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reached {
    /// Its job waited in a pack.
    Nothing,
    /// It had begun.
    Begun,
    /// It had saved a state.
    State,
}

impl Reached {
    /// By whether the attempt had begun, and whether it had saved a state.
    pub(super) fn of(begun: bool, saved: bool) -> Self {
        match (begun, saved) {
            (_, true) => Self::State,
            (true, false) => Self::Begun,
            (false, false) => Self::Nothing,
        }
    }
}

impl FailedAttempt {
    /// Consequence of this attempt after `before` failed ones in a row, by how far it came.
    pub(super) fn consequence(&self, before: u32, reached: Reached) -> Consequence {
        let by_death = matches!(self, Self::CutOff | Self::Expired);
        if by_death && reached != Reached::Begun {
            // The attempt made progress, and the next one continues from there; or its job can't
            // be the cause of the death.
            return Consequence::Waits {
                failed_attempts: 0,
                wait_ms: 0,
            };
        }
        let times = before + 1;
        if times >= TOLERATED_SETBACKS {
            return Consequence::Fails(self.failure(times));
        }
        let wait_ms = match self {
            // The next start of the service makes it wait.
            Self::CutOff => 0,
            Self::Expired | Self::Infrastructure(_) => BACK_OFF_MS[before as usize],
        };
        Consequence::Waits {
            failed_attempts: 1,
            wait_ms,
        }
    }

    /// Kind of end of the attempt, as stored.
    pub(super) fn word(&self) -> &'static str {
        match self {
            Self::CutOff => "cut-off",
            Self::Expired => "expired",
            Self::Infrastructure(_) => "infrastructure",
        }
    }

    /// Details of the end, as stored.
    pub(super) fn detail(&self) -> Option<&str> {
        match self {
            Self::CutOff | Self::Expired => None,
            Self::Infrastructure(detail) => Some(detail),
        }
    }

    fn failure(&self, times: u32) -> Failure {
        match self {
            Self::CutOff | Self::Expired => Failure::cut_off(times),
            Self::Infrastructure(detail) => Failure::infrastructure(times, detail),
        }
    }
}
