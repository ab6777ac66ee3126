//! External conditions of the bodies.

use crate::math::Vec3;
use crate::walls::Plane;

/// External conditions of the bodies' motion.
#[derive(Debug, Clone, Copy)]
pub struct Surroundings<'a> {
    /// The walls.
    pub planes: &'a [Plane],
    /// Gravity [m/s²].
    pub gravity: Vec3,
    /// Simulated time at the start [s].
    pub time: f64,
}
