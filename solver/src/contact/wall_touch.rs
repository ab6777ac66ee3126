//! Contacts of a body with walls, as they are found in a sub-step.

use crate::math::Vec3;

/// A vertex that overlaps a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallTouch {
    /// Place of its springs.
    pub place: usize,
    /// Middle of the overlap, from the centre of mass [m].
    pub arm: Vec3,
    /// Unit normal of the wall.
    pub normal: Vec3,
    /// δ [m].
    pub overlap: f64,
    /// Mass that the contact has to stop (equation 46) [kg].
    pub mass: f64,
    /// Normal force [N].
    pub force: f64,
}
