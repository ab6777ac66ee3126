//! Force of a body on one point (docs/method.md, equations 21–24).

use super::access::{Moving, PointAccess};
use crate::contact::law::ContactLaw;
use crate::kernel::PointStencil;
use crate::math::Vec3;
use crate::method::METHOD;
use crate::rigid::Body;

/// A point that overlaps a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PointContact {
    /// Vector from the body's centre to the point [m].
    pub(super) arm: Vec3,
    /// Unit normal away from the body.
    normal: Vec3,
    /// Velocity of the point relative to the body's there [m/s].
    velocity: Vec3,
    /// δ [m].
    overlap: f64,
    /// δ/(R_p + r).
    overlap_ratio: f64,
    /// Root of the body's turning compliance there [kg^-½].
    pub(super) turning: f64,
    /// Nodes that the point exchanges momentum with.
    pub(super) stencil: PointStencil,
}

/// Force on a point in contact with a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PointForce {
    /// Vector from the body's centre to the point [m].
    pub(super) arm: Vec3,
    /// Force on the point [N].
    pub(super) force: Vec3,
    /// δ/(R_p + r).
    pub(super) overlap_ratio: f64,
    /// Energy stored in the contact [J].
    pub(super) energy: f64,
}

/// Compliances of a contact to unit forces on all contacts at once [1/kg].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Compliance {
    /// Compliance of the body.
    pub(super) body: f64,
    /// Compliance of body and grid.
    pub(super) total: f64,
}

impl PointContact {
    /// Contact of a point with the closest feature of a body; `None` if apart.
    pub(super) fn find<A: PointAccess>(
        points: &A,
        place: A::Place,
        body: &Body,
        stand_off: f64,
    ) -> Option<Self> {
        let Moving { position, velocity } = points.moving(place);
        let arm = position - body.state.position;
        let closest = body.shape.closest_feature(&body.to_body(&arm));
        let reach = stand_off + body.shape.sphero_radius();
        let overlap = reach - closest.distance;
        (overlap > 0.0).then(|| Self {
            arm,
            normal: body.to_world(&closest.normal),
            velocity: velocity - body.velocity_at(&arm),
            overlap,
            overlap_ratio: overlap / reach,
            turning: body.turning_compliance_at(&arm).sqrt(),
            stencil: points.stencil(place),
        })
    }

    /// Positions of the point, and of the body's surface at the contact [m].
    pub(super) fn ends(&self, body: &Body, stand_off: f64) -> (Vec3, Vec3) {
        let point = body.state.position + self.arm;
        (point, point - self.normal * (stand_off - self.overlap))
    }

    /// Force of this contact in a sub-step of `dt` [s], resisted by these compliances.
    pub(super) fn force(&self, law: &ContactLaw, compliance: Compliance, dt: f64) -> PointForce {
        let effective_mass = 1.0 / compliance.total;
        let largest = METHOD.contact.damping_cap * effective_mass / dt;
        let approach = self.velocity.dot(&self.normal);
        let damping = law
            .damping_coefficient(self.overlap, effective_mass)
            .min(largest)
            .max(self.balancing_damping(law, compliance, dt));
        let pressed = (law.elastic_force(self.overlap) - damping * approach).max(0.0);
        let sliding = self.velocity - self.normal * approach;
        let slip = sliding.norm().max(f64::MIN_POSITIVE);
        let friction = largest.min(law.friction * pressed / slip);
        PointForce {
            arm: self.arm,
            force: self.normal * pressed - sliding * friction,
            overlap_ratio: self.overlap_ratio,
            energy: law.elastic_energy(self.overlap),
        }
    }

    /// Damping that takes what the elastic force makes while it is constant over a sub-step:
    /// a body on a spring k, moved by the force at the start, gains as if damped by −k Δt/2.
    fn balancing_damping(&self, law: &ContactLaw, compliance: Compliance, dt: f64) -> f64 {
        let share = compliance.body / compliance.total;
        0.5 * law.tangent_stiffness(self.overlap) * dt * share
    }
}
