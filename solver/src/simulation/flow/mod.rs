//! The flow of a run and the stages of its step, in single or double precision.

mod block_flow;
mod images;
mod no_flow;
mod offending_point;
mod saved_flow;
mod shared;
mod stages;
mod whole;

use super::setup::{Setup, Shares};
use crate::points::Point;
use crate::scenario::Precision;

pub(super) use block_flow::CANDIDATE_BYTES;
pub(super) use offending_point::{Bounds, OffendingPoint};
pub(super) use saved_flow::SavedFlow;
use shared::SharedFlow;
pub(super) use stages::{Flow, StepEnd, StepStart, Substep};
use whole::{restore_whole, start_whole};

/// The restored flow of a run that computes these shares of it.
pub(super) fn restore(saved: SavedFlow, given: &Setup, shares: Option<Shares>) -> Box<dyn Flow> {
    match (saved, shares) {
        (SavedFlow::Share(share, flow), Some(shares)) => {
            Box::new(SharedFlow::restored(*flow, share, shares, given))
        }
        (saved, _) => restore_whole(saved, given),
    }
}

/// A flow of these points in the precision asked for, with these computed shares.
pub(super) fn start(
    points: Vec<Point>,
    given: &Setup,
    precision: Precision,
    shares: Option<Shares>,
) -> Box<dyn Flow> {
    match shares {
        Some(shares) => Box::new(SharedFlow::start(points, shares, given, precision)),
        None => start_whole(points, given, precision),
    }
}
