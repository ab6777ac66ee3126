//! A flow that is computed as a whole.

use super::block_flow::BlockFlow;
use super::no_flow::NoFlow;
use super::saved_flow::SavedFlow;
use super::stages::Flow;
use crate::points::Point;
use crate::scenario::Precision;
use crate::simulation::setup::Setup;

/// A flow of these points, in the precision asked for.
pub(super) fn start_whole(
    points: Vec<Point>,
    given: &Setup,
    precision: Precision,
) -> Box<dyn Flow> {
    match (given.flow.is_some(), precision) {
        (false, _) => Box::new(NoFlow),
        (true, Precision::Single) => Box::new(BlockFlow::<f32>::new(points, given)),
        (true, Precision::Double) => Box::new(BlockFlow::<f64>::new(points, given)),
    }
}

/// The restored flow; of a share, as if that were the whole.
pub(super) fn restore_whole(saved: SavedFlow, given: &Setup) -> Box<dyn Flow> {
    match saved {
        SavedFlow::None => Box::new(NoFlow),
        SavedFlow::Single(blocks) => Box::new(BlockFlow::restored(blocks, given)),
        SavedFlow::Double(blocks) => Box::new(BlockFlow::restored(blocks, given)),
        SavedFlow::Share(_, flow) => restore_whole(*flow, given),
    }
}
