//! How far off an answer may be, from coarser runs of the same scene, and which
//! cells it takes to be no further off than asked (docs/error-bars.md; docs/method.md,
//! section 13).
//!
//! A [`ConvergenceStudy`] lists the runs to be made and turns their outcomes into the answer.
//! It computes nothing itself: who runs it has the threads and the clock.

mod convergence_study;
mod error_bars;
mod fit;
mod refinement_runs;
mod series;
mod target;

pub use convergence_study::ConvergenceStudy;
pub use refinement_runs::StudyRun;
