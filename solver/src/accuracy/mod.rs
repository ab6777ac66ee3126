//! How far off an answer may be, from coarser runs of the same scene, and which
//! cells it takes to be no further off than asked (docs/error-bars.md; docs/method.md,
//! section 13).
//!
//! A [`Campaign`] lists the runs to be made and turns their outcomes into the answer.
//! It computes nothing itself: who runs it has the threads and the clock.

mod bars;
mod campaign;
mod companions;
mod fit;
mod series;
mod target;

pub use campaign::Campaign;
pub use companions::Rung;
