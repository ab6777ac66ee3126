//! Damping forces that take energy whatever the sub-step and however many contacts a
//! body has (docs/method.md, equation 18b).

use crate::rigid::{Body, Load};

/// The damping forces of the contacts of two sides: of a body and the walls, or of two
/// bodies. All of normal direction are one set, those of friction and rolling another.
#[derive(Debug, Clone, Copy, Default)]
pub struct Damping {
    /// Their power, which is not positive [W].
    pub power: f64,
    /// D W D: the power that they would have against the accelerations they give, over
    /// the time these last [W/s].
    pub stopping: f64,
}

impl Damping {
    /// Share of these forces, at most 1, with which a kick of `dt` [s] takes most energy
    /// from the motion. A kick by a share α changes it by α P dt + ½ α² (D W D) dt².
    pub fn share(&self, dt: f64) -> f64 {
        // Rounding can make a power of nothing positive.
        let takes = (-self.power).max(0.0);
        if self.stopping * dt > takes {
            takes / (self.stopping * dt)
        } else {
            1.0
        }
    }
}

/// Damping and losses of the contacts of two sides in a sub-step: what they take for good.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Taken {
    /// Damping forces with their share: of the walls on the body, or of two bodies on the
    /// second, the torque being about the first's centre.
    pub damping: Load,
    /// Energy that slipping took, and springs that got stiffer, turned or were given up
    /// [J].
    pub lost: f64,
}

/// D W D of forces on one body among all the sets of damping forces on it: these may
/// add up, so that each reckons with as many of its kind (Cauchy's inequality).
pub fn stopping(body: &Body, load: &Load) -> f64 {
    if body.is_free() {
        f64::from(sets(body)) * body.response(load)
    } else {
        0.0
    }
}

/// Number of sets of damping forces on a body: two from each side that touches it.
fn sets(body: &Body) -> u32 {
    let walls = u32::from(body.state.wall_overlap > 0.0);
    2 * (body.state.touching_bodies + walls).max(1)
}
