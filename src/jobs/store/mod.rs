//! Store of jobs and results: the port [`JobStore`] that the jobs use, and the types it
//! speaks of. These know no database; each database has a folder of its own ([`sqlite`],
//! [`postgres`]), which alone names its driver and holds its SQL; [`rows`] has the rows that all
//! drivers read. This folder uses neither HTTP nor the
//! solver.
//!
//! A further database is a folder beside these with an implementation of [`JobStore`],
//! a constructor in `tests/mod.rs`, which makes every rule in `tests/` a test of
//! it, and the line that opens the store in `src/service.rs`.

mod claim;
mod counts;
mod ending;
mod error;
mod event;
mod keyed_request;
mod page;
mod port;
pub mod postgres;
mod records;
mod rows;
pub mod sqlite;
mod state;
mod studies;
mod submission;
pub(crate) mod terrains;
#[cfg(test)]
mod tests;

pub use claim::{Claim, Claimant, Dismissal, Lease, Pack, Renewal, Solver};
pub use counts::JobCounts;
pub use ending::{FailedAttempt, Returned, TOLERATED_SETBACKS};
pub use error::{Cause, StoreError, StoreErrorKind};
pub use event::{Change, EVENTS_AT_ONCE, Event};
pub use keyed_request::{FormerRequest, KeptAnswer, Key, KeyRetention};
pub use page::{JobPage, ListedJob, Page, Removal};
pub use port::JobStore;
pub use records::{NewChunk, NewResults, StoredChunk};
pub use state::{AttemptStart, ResumePoint, StoredState};
pub use studies::{
    EndedMember, Enlarged, ListedMember, MemberOutcome, MemberWork, NewMember, NewStudy,
    StudyDismissal, StudyEnd, StudyPage, StudyStore, StudySubmitted,
};
pub use submission::{Room, Submission, Submitted};
pub use terrains::{NewTerrain, StoredTerrain, TerrainPage, TerrainRemoval, TerrainStore};
