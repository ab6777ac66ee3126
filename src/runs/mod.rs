//! Runs of one scenario, without the service: [`run`](mod@run) computes it from its start or from
//! a saved state, [`convergence_study`] makes the refinement runs of its uncertainty intervals
//! before. The command line, the verification and the workers of the service all compute scenarios
//! this way; records and progress go to a [`Sink`] of theirs.

mod control;
pub mod convergence_study;
mod headed;
mod pace;
mod progress;
pub mod run;
mod saved_run;
mod saved_study;
mod study_progress;
mod watch;

pub use control::{RunControl, Stop};
pub use progress::{Progress, ProgressBoard, Resources};
pub use run::{NoSink, Run, RunEnd, RunError, Sink};
pub use saved_run::{COMMIT, SavedRunError};
