//! Access of the contacts to the points of a flow.

use super::around::Around;
use crate::kernel::PointStencil;
use crate::math::Vec3;

/// Access to the points of a flow for contacts within a step.
pub trait PointAccess: Sync {
    /// Place of a point in memory, from one transfer to the next.
    type Place: Copy + Send + Sync;
    /// Finds the points that were within a box at the transfer.
    fn find_within(&self, around: &Around, found: &mut Vec<Self::Place>);
    /// Position of a point at the transfer [m].
    fn resting(&self, place: Self::Place) -> Vec3;
    /// Nodes that a point exchanges momentum with until the next transfer.
    fn stencil(&self, place: Self::Place) -> PointStencil;
    /// Current state of a point.
    fn moving(&self, place: Self::Place) -> Moving;
}

/// State of a point within a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moving {
    /// Current position [m].
    pub position: Vec3,
    /// Current velocity [m/s].
    pub velocity: Vec3,
}
