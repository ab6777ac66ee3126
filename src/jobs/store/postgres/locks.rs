//! Locks that hold for a transaction, where rows alone would not do: rules about numbers of rows,
//! and orders.

use super::error::Answer;
use sqlx::{Postgres, Transaction};

/// Work that one transaction does at a time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Turn {
    /// Submissions of jobs, which count those that wait.
    Submission,
    /// Submissions of studies, which count those that run.
    Study,
    /// Removals: the last job of a key releases it.
    Removal,
    /// Numbering of events.
    Numbering,
}

impl Turn {
    /// The lock's key. The first half is this program's among all that use advisory locks.
    fn key(self) -> i64 {
        let place = match self {
            Self::Submission => 1,
            Self::Study => 2,
            Self::Removal => 3,
            Self::Numbering => 4,
        };
        (PROGRAM << 32) | place
    }

    /// Waits for the turn; it ends with the transaction.
    pub(super) async fn take(self, transaction: &mut Transaction<'_, Postgres>) -> Answer<()> {
        sqlx::query("SELECT pg_advisory_xact_lock($1)")
            .bind(self.key())
            .execute(&mut **transaction)
            .await?;
        Ok(())
    }
}

/// Key of the service that leads: see `leader.rs`.
pub(super) const LEADER: i64 = (PROGRAM << 32) | 5;

/// "scre" in ASCII.
const PROGRAM: i64 = 0x7363_7265;
