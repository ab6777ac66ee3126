//! Balance of each body's energy over a run (docs/method.md, equation 38a).

use crate::contact::body_body::ContactPair;
use crate::contact::island::EnergyReport;
use crate::math::Vec3;
use crate::rigid::Body;
use serde::{Deserialize, Serialize};

/// Balance of a free body's energy so far.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct BodyEnergy {
    /// Energy at the start, including potential energy and that of its contacts [J].
    pub start: f64,
    /// Work of the flow on it [J].
    pub flow_work: f64,
    /// Energy received from other bodies, as [`EnergyReport::bodies`] counts it [J].
    pub body_work: f64,
    /// Energy dissipated by damping and slip in its contacts [J].
    pub dissipated: f64,
    /// Part of the last sub-step's dissipation that takes effect in the next kick [J].
    pending: f64,
    /// Energy that nothing accounts for, positive if made [J].
    pub made: f64,
    least_made: f64,
    largest_rise: f64,
    /// Accumulated magnitudes of the work of flow and bodies [J].
    exchanged: f64,
    /// Largest kinetic energy, that of its contacts included [J].
    largest_present: f64,
    /// Least and largest potential energy [J].
    lowest: f64,
    highest: f64,
}

impl BodyEnergy {
    /// The balances of bodies that start in this state, under gravity [m/s²].
    pub fn of(bodies: &[Body], contact_pairs: &[ContactPair], gravity: &Vec3) -> Vec<Self> {
        let start = |(place, body): (usize, &Body)| {
            let present = body.kinetic_energy() + stored(place, bodies, contact_pairs);
            let potential = potential(body, gravity);
            Self {
                start: present + potential,
                largest_present: present,
                lowest: potential,
                highest: potential,
                ..Self::default()
            }
        };
        bodies.iter().enumerate().map(start).collect()
    }

    /// Adds a sub-step of the flow, which ended with the body in this state.
    pub fn take_in(&mut self, report: &EnergyReport, body: &Body, gravity: &Vec3) {
        self.flow_work += report.flow;
        self.body_work += report.bodies;
        self.exchanged += report.flow.abs() + report.bodies.abs();
        let early = report.pending - self.pending;
        self.pending = report.pending;
        self.dissipated += report.dissipated - early;
        self.made += report.made - early;
        self.least_made = self.least_made.min(self.made);
        self.largest_rise = self.largest_rise.max(self.made - self.least_made);
        self.largest_present = self.largest_present.max(report.present);
        let potential = potential(body, gravity);
        self.lowest = self.lowest.min(potential);
        self.highest = self.highest.max(potential);
    }

    /// Largest rise of the energy made above its running minimum [J].
    pub fn rise(&self) -> f64 {
        self.largest_rise
    }

    /// Energy that a rise is compared with [J]: the largest that the body had, its exchange with
    /// flow and bodies, the range of its potential energy, and that of a fall by its own size.
    pub fn scale(&self, body: &Body, gravity: &Vec3) -> f64 {
        let own_size = body.mass * gravity.norm() * body.shape.bounding_radius();
        self.largest_present + self.exchanged + (self.highest - self.lowest) + own_size
    }
}

/// Energy stored in the contacts of a body [J]; half of that in contacts with another free
/// body.
pub fn stored(place: usize, bodies: &[Body], contact_pairs: &[ContactPair]) -> f64 {
    let with_bodies = contact_pairs
        .iter()
        .filter(|contact_pair| contact_pair.bodies.contains(&place))
        .map(|contact_pair| {
            let free = contact_pair
                .bodies
                .iter()
                .all(|&place| bodies[place].is_free());
            if free {
                0.5 * contact_pair.energy
            } else {
                contact_pair.energy
            }
        });
    bodies[place].state.wall_energy + with_bodies.sum::<f64>()
}

/// Potential energy of a body, counted from the floor [J].
pub fn potential(body: &Body, gravity: &Vec3) -> f64 {
    -body.mass * gravity.dot(&body.state.position)
}
