//! Damping forces that dissipate energy for any sub-step and any number of contacts of a body
//! (docs/method.md, equation 18b).

use crate::rigid::{Body, Load};

/// The damping forces of the contacts of two sides: of a body and the walls, or of two bodies.
/// All normal ones are one set, those of friction and rolling another.
#[derive(Debug, Clone, Copy, Default)]
pub struct Damping {
    /// Their power, which is not positive [W].
    pub power: f64,
    /// D W D: the power of these forces at the accelerations that they give, over their duration
    /// [W/s].
    pub stopping: f64,
}

impl Damping {
    /// Share of these forces, at most 1, with which a kick of `dt` [s] dissipates most energy. A
    /// kick by a share α changes the energy by α P dt + ½ α² (D W D) dt².
    pub fn share(&self, dt: f64) -> f64 {
        // Rounding can make a vanishing power positive.
        let takes = (-self.power).max(0.0);
        if self.stopping * dt > takes {
            takes / (self.stopping * dt)
        } else {
            1.0
        }
    }
}

/// Damping and losses of the contacts of two sides in a sub-step: their dissipation.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Taken {
    /// Damping forces with their share: of the walls on the body, or of two bodies on the
    /// second, the torque being about the first's centre.
    pub damping: Load,
    /// Power of these in the middle of the kick by them [W].
    pub power: f64,
    /// Energy lost by slip, and by springs that got stiffer, turned or were released [J].
    pub lost: f64,
}

/// D W D of forces on one body among all the sets of damping forces on it: they may add up, so
/// the result is multiplied by the number of sets (Cauchy's inequality).
pub fn stopping(body: &Body, load: &Load) -> f64 {
    if body.is_free() {
        f64::from(sets(body)) * body.response(load)
    } else {
        0.0
    }
}

/// Number of sets of damping forces on a body: two per side that touches it.
fn sets(body: &Body) -> u32 {
    let walls = u32::from(body.state.wall_overlap > 0.0);
    2 * (body.state.touching_bodies + walls).max(1)
}
