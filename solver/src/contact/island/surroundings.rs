//! External conditions of the bodies.

use crate::cancellation::Cancellation;
use crate::math::Vec3;
use crate::walls::RigidWalls;

/// External conditions of the bodies' motion.
#[derive(Debug, Clone, Copy)]
pub struct Surroundings<'a> {
    /// The walls.
    pub walls: RigidWalls<'a>,
    /// Gravity [m/s²].
    pub gravity: Vec3,
    /// Simulated time at the start [s].
    pub time: f64,
    /// Request to give the run up; `None` where nobody can make one.
    pub cancellation: Option<&'a Cancellation>,
}

impl Surroundings<'_> {
    /// True if the run is to be given up.
    pub(super) fn is_cancelled(&self) -> bool {
        self.cancellation.is_some_and(Cancellation::is_asked)
    }
}
