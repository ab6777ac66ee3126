//! Contacts of two bodies: their forces and their history (docs/method.md, equations 43–47).

use crate::contact::dissipation::{Damping, Taken, stopping};
use crate::contact::friction::Spring;
use crate::contact::law::{ContactLaw, effective_contact_mass};
use crate::math::Vec3;
use crate::rigid::{Body, Load};
use serde::{Deserialize, Serialize};

mod contact_points;
mod history;
mod motion;
mod near_features;
mod segments;
mod separation;

pub use contact_points::Contacts;
use contact_points::{Contact, ContactPoint, contacts};
use history::{FeatureSprings, carry_history, energy_of};
use motion::Motion;
pub use separation::{Separation, distance, least_gap};

/// History of the contacts of two bodies, kept from one body sub-step to the next.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ContactPair {
    /// Indices of the two in the list of bodies, the lower first.
    pub bodies: [usize; 2],
    springs: Vec<FeatureSprings>,
    /// Deepest overlap now [m]; 0 when apart.
    pub deepest: f64,
    /// Energy stored in their contacts now [J].
    pub energy: f64,
    /// Load on the second now, the torque being about the first's centre.
    pub push: Load,
}

/// Loads that two bodies exert on each other.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Exchange {
    /// Load on the first body.
    pub on_first: Load,
    /// Load on the second body: the opposite force on the same line.
    pub on_second: Load,
}

impl ContactPair {
    /// History of two bodies that have not touched yet.
    pub fn new(bodies: [usize; 2]) -> Self {
        Self {
            bodies,
            springs: Vec::new(),
            deepest: 0.0,
            energy: 0.0,
            push: Load::default(),
        }
    }

    /// True if they touch.
    pub fn touches(&self) -> bool {
        self.deepest > 0.0
    }

    /// Finds the contacts of the two after a drift in place of those `found` before, and updates
    /// what is known of their separation.
    pub fn find(
        &mut self,
        pair: [&Body; 2],
        law: &ContactLaw,
        separation: &mut Separation,
        found: &mut Contacts,
    ) {
        contacts(pair, law, separation, found);
        let overlaps = found.places.iter().map(|contact| contact.near.overlap);
        self.deepest = overlaps.fold(0.0, f64::max);
    }

    /// Updates springs and forces of the contacts found after a drift of `dt`; returns their
    /// dissipation.
    pub fn touch(
        &mut self,
        [first, second]: [&Body; 2],
        law: &ContactLaw,
        found: &mut Contacts,
        dt: f64,
    ) -> Taken {
        let held = energy_of(&self.springs);
        self.push = found.push;
        self.energy = found.energy;
        if found.places.is_empty() {
            self.springs.clear();
            return Taken {
                lost: held,
                ..Taken::default()
            };
        }
        let Contacts {
            places,
            pressed,
            springs,
            push,
            ..
        } = found;
        let pair = Pair::new(first, second, law, push);
        std::mem::swap(&mut self.springs, springs);
        carry_history(springs, places, pair.radii, law, &mut self.springs);
        let mut taken = Taken {
            lost: (held - energy_of(&self.springs)).max(0.0),
            ..Taken::default()
        };
        pair.press(places, dt, pressed);
        for (contact, pressed) in places.iter().zip(&*pressed) {
            let ContactPoint { place, normal, .. } = &contact.near;
            taken.damping.add_at(place, &(normal * pressed.damping));
        }
        self.push.add(&taken.damping);
        let rubbed = pair.rub(places, pressed, &mut self.springs, dt);
        self.energy += rubbed.energy;
        self.push.add(&rubbed.load);
        taken.damping.add(&rubbed.taken.damping);
        taken.lost += rubbed.taken.lost;
        taken
    }

    /// Approach speeds and overlaps of their contacts, as last found [m/s, m].
    pub fn approaches<'a>(
        [first, second]: [&Body; 2],
        found: &'a Contacts,
    ) -> impl Iterator<Item = (f64, f64)> + 'a {
        let apart = second.state.position - first.state.position;
        let motions = [first, second].map(Motion::velocity);
        found.places.iter().map(move |Contact { near, .. }| {
            let velocity = relative(&motions, &near.place, &apart);
            (-velocity.dot(&near.normal), near.overlap)
        })
    }

    /// Loads that the two exert on each other now.
    pub fn exchange(&self, pair: [&Body; 2]) -> Exchange {
        Exchange::between(pair, &self.push)
    }
}

/// Two bodies, and the quantities that do not depend on the contact.
struct Pair<'a> {
    bodies: [&'a Body; 2],
    law: &'a ContactLaw,
    /// Vector from the first body's centre to the second's.
    apart: Vec3,
    /// Sum of the sphero radii.
    radii: f64,
    velocities: [Motion; 2],
    /// Accelerations that the elastic forces of all contacts give.
    accelerations: [Motion; 2],
    reduced_mass: f64,
    /// Rolling resistance: the larger of the two bodies'.
    rolling: f64,
}

/// The normal force of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Pressed {
    /// Velocity of the second body at the contact relative to the first's [m/s].
    velocity: Vec3,
    /// Effective contact mass [kg].
    mass: f64,
    /// Normal force of the whole contact [N].
    force: f64,
    /// The damping part of the force, with the contact's share [N].
    damping: f64,
}

/// Friction and rolling resistance on the second body, the torque being about the first's
/// centre.
struct Rubbed {
    load: Load,
    /// Energy stored in their springs [J].
    energy: f64,
    /// Damping and losses of friction and rolling only.
    taken: Taken,
}

impl<'a> Pair<'a> {
    fn new(first: &'a Body, second: &'a Body, law: &'a ContactLaw, push: &Load) -> Self {
        let apart = second.state.position - first.state.position;
        let exchange = Exchange::of(push, &apart);
        Self {
            bodies: [first, second],
            law,
            apart,
            radii: first.shape.sphero_radius() + second.shape.sphero_radius(),
            velocities: [first, second].map(Motion::velocity),
            accelerations: [
                Motion::acceleration(first, &exchange.on_first),
                Motion::acceleration(second, &exchange.on_second),
            ],
            reduced_mass: reduced_mass(first, second),
            rolling: first.rolling_friction.max(second.rolling_friction),
        }
    }

    /// Angular velocity of the second body relative to the first's.
    fn spin(&self) -> Vec3 {
        self.velocities[1].angular - self.velocities[0].angular
    }

    /// Mean angular velocity, with which the springs turn.
    fn turning(&self) -> Vec3 {
        0.5 * (self.velocities[0].angular + self.velocities[1].angular)
    }

    /// Motion of the second body relative to the first's at a place given from the
    /// first's centre.
    fn relative(&self, motions: &[Motion; 2], place: &Vec3) -> Vec3 {
        relative(motions, place, &self.apart)
    }

    /// R* of 1/R* = 1/r_a + 1/r_b [m].
    fn equivalent_radius(&self) -> f64 {
        let [a, b] = self.bodies.map(|body| body.shape.sphero_radius());
        a * b / (a + b)
    }

    /// Normal forces, with the share of damping that takes energy (equation 18b), in place of those
    /// in `pressed`.
    fn press(&self, contacts: &[Contact], dt: f64, pressed: &mut Vec<Pressed>) {
        let (mut damping, mut sum) = (Damping::default(), Load::default());
        pressed.clear();
        pressed.extend(contacts.iter().map(|contact| {
            let near = &contact.near;
            let elastic = self.law.elastic_force(near.overlap);
            let parting = self.relative(&self.accelerations, &near.place);
            let mass =
                effective_contact_mass(elastic, parting.dot(&near.normal), self.reduced_mass);
            let velocity = self.relative(&self.velocities, &near.place);
            let approach = -velocity.dot(&near.normal);
            let force = self.law.normal_force(near.overlap, approach, mass);
            let part = contact.share * (force - elastic);
            damping.power -= part * approach;
            sum.add_at(&near.place, &(near.normal * part));
            Pressed {
                velocity,
                mass,
                force,
                damping: part,
            }
        }));
        damping.stopping = self.stopping(&sum);
        let share = damping.share(dt);
        for (contact, pressed) in contacts.iter().zip(pressed) {
            let left_out = (1.0 - share) * pressed.damping;
            pressed.damping -= left_out;
            pressed.force -= left_out / contact.share;
        }
    }

    /// Friction and rolling resistance, with the share of damping that takes energy.
    fn rub(
        &self,
        contacts: &[Contact],
        pressed: &[Pressed],
        springs: &mut [FeatureSprings],
        dt: f64,
    ) -> Rubbed {
        let mut rubbed = Rubbed {
            load: Load::default(),
            energy: 0.0,
            taken: Taken::default(),
        };
        let radius = self.equivalent_radius();
        let (mut damping, mut sum) = (Damping::default(), Load::default());
        for ((contact, pressed), springs) in contacts.iter().zip(pressed).zip(springs) {
            let (near, share) = (&contact.near, contact.share);
            let viscous = share * self.law.tangential_damping(near.overlap, pressed.mass);
            let across = |v: &Vec3| v - near.normal * v.dot(&near.normal);
            let mut resist = |spring: &mut Spring, velocity: Vec3, friction: f64| {
                let cap = friction * pressed.force * share;
                let before = *spring;
                spring.turn(&self.turning(), &near.normal, dt);
                let found = spring.resist(&before, &velocity, viscous, cap, dt);
                rubbed.taken.lost += found.lost;
                rubbed.energy += spring.energy();
                damping.power += found.viscous.dot(&velocity);
                [found.elastic, found.viscous]
            };
            let sliding = across(&pressed.velocity);
            let [elastic, part] = resist(&mut springs.sliding, sliding, self.law.friction);
            rubbed.load.add_at(&near.place, &elastic);
            sum.add_at(&near.place, &part);
            if self.rolling > 0.0 {
                let turning = across(&self.spin()) * radius;
                let [elastic, part] = resist(&mut springs.rolling, turning, self.rolling);
                rubbed.load.torque += elastic * radius;
                sum.torque += part * radius;
            }
        }
        damping.stopping = self.stopping(&sum);
        rubbed.taken.damping = sum.times(damping.share(dt));
        rubbed.load.add(&rubbed.taken.damping);
        rubbed
    }

    /// D W D of damping forces on the second body and their opposites on the first, the
    /// torque being about the first's centre.
    fn stopping(&self, forces: &Load) -> f64 {
        let exchange = Exchange::of(forces, &self.apart);
        let [first, second] = self.bodies;
        stopping(first, &exchange.on_first) + stopping(second, &exchange.on_second)
    }
}

/// Motion of a second body relative to a first's at a place given from the first's centre; `apart`
/// is the vector from there to the second's.
fn relative([first, second]: &[Motion; 2], place: &Vec3, apart: &Vec3) -> Vec3 {
    second.at(&(place - apart)) - first.at(place)
}

impl Exchange {
    /// Loads on two bodies when the second is pushed, the torque being about the first's centre.
    pub fn between([first, second]: [&Body; 2], push: &Load) -> Self {
        Self::of(push, &(second.state.position - first.state.position))
    }

    /// Loads when the second body is pushed, the torque being about the first's centre; `apart` is
    /// the vector from there to the second's.
    fn of(push: &Load, apart: &Vec3) -> Self {
        Self {
            on_first: Load {
                force: -push.force,
                torque: -push.torque,
            },
            on_second: Load {
                force: push.force,
                torque: push.torque - apart.cross(&push.force),
            },
        }
    }
}

/// Reduced mass of two bodies [kg]; of two fixed or prescribed bodies none.
pub fn reduced_mass(first: &Body, second: &Body) -> f64 {
    1.0 / (first.inverse_mass() + second.inverse_mass())
}

/// Law of the contacts of two bodies.
pub fn pair_law(first: &Body, second: &Body) -> ContactLaw {
    ContactLaw::of_pair(
        [&first.wall_law, &second.wall_law],
        [first.shape.sphero_radius(), second.shape.sphero_radius()],
    )
}

#[cfg(test)]
mod tests;
