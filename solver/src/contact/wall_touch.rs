//! Contacts of a body with walls in a sub-step.

use crate::math::Vec3;

/// A vertex that overlaps a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallTouch {
    /// Index of its springs.
    pub place: usize,
    /// Middle of the overlap, from the centre of mass [m].
    pub arm: Vec3,
    /// Unit normal of the wall.
    pub normal: Vec3,
    /// δ [m].
    pub overlap: f64,
    /// Effective contact mass (equation 46) [kg].
    pub mass: f64,
    /// Normal force [N].
    pub force: f64,
}
