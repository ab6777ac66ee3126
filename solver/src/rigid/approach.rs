//! Bound of the speed at which two bodies approach each other.

use super::{Body, Freedom};

/// Bound of the speed at which any place of a body approaches any of another while the momenta of
/// both are constant, however they turn, or at any time of a prescribed motion [m/s].
pub fn approach_bound(first: &Body, second: &Body) -> f64 {
    first.speed_bound() + second.speed_bound()
}

impl Body {
    /// Bound of the speed of any place of it; 0 for a fixed body [m/s].
    fn speed_bound(&self) -> f64 {
        match self.freedom {
            Freedom::Fixed => 0.0,
            Freedom::Prescribed(_) => self.speed_ahead(),
            Freedom::Free | Freedom::InPlane => {
                let turning = self.inverse_inertia.norm() * self.state.angular_momentum.norm();
                self.velocity().norm() + turning * self.shape.bounding_radius()
            }
        }
    }
}
