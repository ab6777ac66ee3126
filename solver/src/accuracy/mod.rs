//! Error of an answer, estimated from coarser runs of the same scene, and the cell size that
//! keeps it within a given tolerance (docs/error-bars.md; docs/method.md, section 13).
//!
//! A [`ConvergenceStudy`] lists the runs to be made and turns their outcomes into the answer.
//! It computes nothing itself: its caller has the threads and the clock.

mod convergence_study;
mod error_bars;
mod fit;
mod refinement_runs;
mod series;
mod target;

pub use convergence_study::ConvergenceStudy;
pub use refinement_runs::StudyRun;
