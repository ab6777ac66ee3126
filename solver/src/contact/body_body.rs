//! Bodies on bodies: what two of them do to each other, and what their
//! contacts remember (docs/method.md, equations 43–46).

use crate::contact::law::{ContactLaw, TANGENTIAL_STIFFNESS_RATIO, mass_seen};
use crate::math::Vec3;
use crate::rigid::{Body, Freedom, Load};
use serde::{Deserialize, Serialize};

mod places;
mod segments;

pub use places::least_gap;
use places::{Between, Contact, Contacts, contacts};

/// What the contacts of two bodies remember from one body sub-step to the next.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Meeting {
    /// Places of the two in the list of bodies, the lower first.
    pub bodies: [usize; 2],
    springs: Vec<Spring>,
    /// Deepest overlap now [m]; 0 when apart.
    pub deepest: f64,
    /// Energy their contacts hold now [J].
    pub energy: f64,
}

/// The tangential spring of one contact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Spring {
    between: Between,
    /// Where the contact is, from the first body's centre [m].
    place: Vec3,
    /// How far the second body slid on the first [m].
    stretch: Vec3,
}

/// What two bodies do to each other.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Exchange {
    /// On the first.
    pub on_first: Load,
    /// On the second: the opposite force on the same line.
    pub on_second: Load,
}

impl Meeting {
    /// Of two bodies that have not met.
    pub fn new(bodies: [usize; 2]) -> Self {
        Self {
            bodies,
            springs: Vec::new(),
            deepest: 0.0,
            energy: 0.0,
        }
    }

    /// Whether they touch.
    pub fn touches(&self) -> bool {
        self.deepest > 0.0
    }

    /// Renews springs and forces after a drift of `dt`.
    pub fn touch(&mut self, first: &Body, second: &Body, law: &ContactLaw, dt: f64) -> Exchange {
        let found = contacts(first, second, law);
        let pair = Pair::new(first, second);
        let before = std::mem::take(&mut self.springs);
        let mut push = found.push;
        self.energy = found.energy;
        self.deepest = 0.0;
        for contact in &found.places {
            let mut spring = Spring {
                between: contact.between,
                place: contact.near.place,
                stretch: remembered(&before, contact, pair.radii),
            };
            let felt = pair.felt(&found, contact, law);
            let (force, held) = felt.resist(&mut spring.stretch, dt);
            push.add_at(&contact.near.place, &force);
            self.energy += held;
            self.deepest = self.deepest.max(contact.near.overlap);
            self.springs.push(spring);
        }
        pair.exchange(&push)
    }
}

/// Stretch of a contact's spring so far. One that comes up where another was,
/// as when a vertex slides over a rim, takes that one's over.
fn remembered(before: &[Spring], contact: &Contact, reach: f64) -> Vec3 {
    let own = before
        .iter()
        .find(|spring| spring.between == contact.between);
    if let Some(spring) = own {
        return spring.stretch;
    }
    let distance = |spring: &Spring| (spring.place - contact.near.place).norm();
    let near = before.iter().filter(|spring| distance(spring) < reach);
    let nearest = near.min_by(|a, b| distance(a).total_cmp(&distance(b)));
    nearest.map_or_else(Vec3::zeros, |spring| spring.stretch)
}

/// Two bodies, and what does not depend on the contact.
struct Pair<'a> {
    bodies: [&'a Body; 2],
    /// From the first's centre to the second's.
    apart: Vec3,
    /// Sum of the sphero radii.
    radii: f64,
    /// Mean angular velocity, with which the springs turn.
    turning: Vec3,
}

/// One contact with the motion in it.
struct Felt<'a> {
    contact: &'a Contact,
    law: &'a ContactLaw,
    /// Velocity of the second body there relative to the first's.
    velocity: Vec3,
    /// Mass that it has to stop [kg].
    mass: f64,
    turning: Vec3,
}

impl<'a> Pair<'a> {
    fn new(first: &'a Body, second: &'a Body) -> Self {
        Self {
            bodies: [first, second],
            apart: second.state.position - first.state.position,
            radii: first.shape.sphero_radius() + second.shape.sphero_radius(),
            turning: 0.5 * (spin(first) + spin(second)),
        }
    }

    /// Arms of a place given from the first's centre.
    fn arms(&self, place: &Vec3) -> [Vec3; 2] {
        [*place, place - self.apart]
    }

    fn felt(&self, found: &Contacts, contact: &'a Contact, law: &'a ContactLaw) -> Felt<'a> {
        let near = &contact.near;
        let [on_first, on_second] = self.arms(&near.place);
        let [first, second] = self.bodies;
        let exchange = self.exchange(&found.push);
        let parting = acceleration_at(second, &exchange.on_second, &on_second)
            - acceleration_at(first, &exchange.on_first, &on_first);
        Felt {
            contact,
            law,
            velocity: velocity_at(second, &on_second) - velocity_at(first, &on_first),
            mass: mass_seen(
                law.elastic_force(near.overlap),
                parting.dot(&near.normal),
                reduced_mass(first, second),
            ),
            turning: self.turning,
        }
    }

    /// What both feel when the second is pushed, torque about the first's centre.
    fn exchange(&self, push: &Load) -> Exchange {
        Exchange {
            on_first: Load {
                force: -push.force,
                torque: -push.torque,
            },
            on_second: Load {
                force: push.force,
                torque: push.torque - self.apart.cross(&push.force),
            },
        }
    }
}

impl Felt<'_> {
    /// Damping and friction on the second body [N], and the energy the spring
    /// holds [J].
    fn resist(&self, stretch: &mut Vec3, dt: f64) -> (Vec3, f64) {
        let near = &self.contact.near;
        let along = self.velocity.dot(&near.normal);
        let normal_force = self.law.normal_force(near.overlap, -along, self.mass);
        let damping = normal_force - self.law.elastic_force(near.overlap);
        let sliding = self.velocity - near.normal * along;
        // The spring turns with the bodies, and stays in the contact's plane.
        *stretch += self.turning.cross(stretch) * dt;
        *stretch -= near.normal * stretch.dot(&near.normal);
        *stretch += sliding * dt;
        let tangential =
            self.law
                .tangential_force(stretch, &sliding, (near.overlap, normal_force, self.mass));
        let stretched = 0.5
            * TANGENTIAL_STIFFNESS_RATIO
            * self.law.tangent_stiffness(near.overlap)
            * stretch.norm_squared();
        let share = self.contact.share;
        (
            (near.normal * damping + tangential) * share,
            stretched * share,
        )
    }
}

/// A fixed body does not turn.
fn spin(body: &Body) -> Vec3 {
    match body.freedom {
        Freedom::Free => body.angular_velocity(),
        Freedom::Fixed => Vec3::zeros(),
    }
}

fn velocity_at(body: &Body, arm: &Vec3) -> Vec3 {
    match body.freedom {
        Freedom::Free => body.velocity_at(arm),
        Freedom::Fixed => Vec3::zeros(),
    }
}

/// Acceleration at `arm` that a load gives a body from rest [m/s²].
fn acceleration_at(body: &Body, load: &Load, arm: &Vec3) -> Vec3 {
    match body.freedom {
        Freedom::Free => body.acceleration_at(load, arm),
        Freedom::Fixed => Vec3::zeros(),
    }
}

/// Mass of the motion of two bodies towards each other [kg]; of two fixed ones none.
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
