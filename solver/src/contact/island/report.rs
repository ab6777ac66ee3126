//! Report of a body's motion in one sub-step of the flow.

use crate::rigid::Load;
use crate::walls::Impulse;

/// Report of one flow sub-step of a body.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BodyReport {
    /// Impulse of the walls, about the origin.
    pub wall: Impulse,
    /// Impulse of fixed and prescribed bodies, about the origin.
    pub barrier: Impulse,
    /// Impulse of gravity, about the origin.
    pub gravity: Impulse,
    /// Mean force and torque of the walls.
    pub wall_load: Load,
    /// Mean force and torque of all other bodies.
    pub body_load: Load,
    /// Work that a prescribed motion did on other bodies [J].
    pub work: f64,
    /// Balance of its energy.
    pub energy: EnergyReport,
    /// Body sub-steps.
    pub substeps: u32,
    /// Body sub-steps that contacts and spin require; none are taken if they are more than
    /// the method's number.
    pub substeps_asked: f64,
    /// Share of the time in body sub-steps that ended in contact with a wall or another body.
    pub supported_share: f64,
    /// Upper bound of the path of any of its places [m].
    pub travelled: f64,
    /// Its deepest overlap with a wall or another body, over its sphero radius
    /// or that of the other if smaller.
    pub deepest_overlap_ratio: f64,
}

impl BodyReport {
    /// Adds an overlap over a sphero radius.
    pub(super) fn overlap(&mut self, ratio: f64) {
        self.deepest_overlap_ratio = self.deepest_overlap_ratio.max(ratio);
    }
}

/// Energy of a body in a sub-step of the flow, by cause [J]. Contacts with another free body
/// are halved between the two.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct EnergyReport {
    /// Work of the flow on it.
    pub flow: f64,
    /// Work of gravity.
    pub gravity: f64,
    /// Energy received from other bodies: the work of prescribed motions, and half of the
    /// difference of a contact's work on it and on the other free body.
    pub bodies: f64,
    /// Energy dissipated by damping and slip, in its contacts with walls and bodies.
    pub dissipated: f64,
    /// Part of this that the kick before the next drift will dissipate.
    pub pending: f64,
    /// Change of its kinetic and stored energy, less all known terms.
    pub made: f64,
    /// Kinetic energy and energy stored in its contacts at the end.
    pub present: f64,
}
