//! Bodies on bodies: what two of them do to each other, and what their
//! contacts remember (docs/method.md, equations 43–47).

use crate::contact::law::{ContactLaw, mass_seen};
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
    /// How far it rolled on it, as an angle × the equivalent radius [m].
    rolling: Vec3,
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
            let mut spring = remembered(&before, contact, pair.radii);
            let felt = pair.felt(&found, contact, law);
            let (force, held) = felt.resist(&mut spring.stretch, dt);
            push.add_at(&contact.near.place, &force);
            self.energy += held;
            if pair.rolling > 0.0 {
                let (couple, held) = felt.resist_rolling(&mut spring.rolling, dt);
                push.torque += couple;
                self.energy += held;
            }
            self.deepest = self.deepest.max(contact.near.overlap);
            self.springs.push(spring);
        }
        pair.exchange(&push)
    }
}

/// A contact's spring so far. One that comes up where another was, as when a
/// vertex slides over a rim, takes that one's stretch over.
fn remembered(before: &[Spring], contact: &Contact, reach: f64) -> Spring {
    let distance = |spring: &Spring| (spring.place - contact.near.place).norm();
    let own = before
        .iter()
        .find(|spring| spring.between == contact.between);
    let nearest = || {
        let near = before.iter().filter(|spring| distance(spring) < reach);
        near.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    };
    let heir_of = own.or_else(nearest);
    Spring {
        between: contact.between,
        place: contact.near.place,
        stretch: heir_of.map_or_else(Vec3::zeros, |spring| spring.stretch),
        rolling: heir_of.map_or_else(Vec3::zeros, |spring| spring.rolling),
    }
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
    /// Angular velocity of the second body relative to the first's.
    spin: Vec3,
    /// Rolling resistance: that of the body that resists more.
    rolling: f64,
}

/// One contact with the motion in it.
struct Felt<'a> {
    contact: &'a Contact,
    law: &'a ContactLaw,
    /// Velocity of the second body there relative to the first's.
    velocity: Vec3,
    /// Mass that it has to stop [kg].
    mass: f64,
    pair: &'a Pair<'a>,
}

impl<'a> Pair<'a> {
    fn new(first: &'a Body, second: &'a Body) -> Self {
        Self {
            bodies: [first, second],
            apart: second.state.position - first.state.position,
            radii: first.shape.sphero_radius() + second.shape.sphero_radius(),
            turning: 0.5 * (spin(first) + spin(second)),
            spin: spin(second) - spin(first),
            rolling: first.rolling_friction.max(second.rolling_friction),
        }
    }

    /// R* of 1/R* = 1/r_a + 1/r_b [m].
    fn equivalent_radius(&self) -> f64 {
        let [a, b] = self.bodies.map(|body| body.shape.sphero_radius());
        a * b / (a + b)
    }

    /// Arms of a place given from the first's centre.
    fn arms(&self, place: &Vec3) -> [Vec3; 2] {
        [*place, place - self.apart]
    }

    fn felt(&'a self, found: &Contacts, contact: &'a Contact, law: &'a ContactLaw) -> Felt<'a> {
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
            pair: self,
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
        self.turn(stretch, dt);
        *stretch += sliding * dt;
        let tangential =
            self.law
                .tangential_force(stretch, &sliding, (near.overlap, normal_force, self.mass));
        let stretched = self.law.stretched_energy(stretch, near.overlap);
        let share = self.contact.share;
        (
            (near.normal * damping + tangential) * share,
            stretched * share,
        )
    }
}

impl Felt<'_> {
    /// A spring turns with the bodies, and stays in the contact's plane.
    fn turn(&self, stretch: &mut Vec3, dt: f64) {
        let normal = &self.contact.near.normal;
        *stretch += self.pair.turning.cross(stretch) * dt;
        *stretch -= normal * stretch.dot(normal);
    }

    /// Couple against rolling on the second body [N m], and the energy its spring
    /// holds [J].
    fn resist_rolling(&self, stretch: &mut Vec3, dt: f64) -> (Vec3, f64) {
        let near = &self.contact.near;
        let along = self.velocity.dot(&near.normal);
        let pressed = self.law.normal_force(near.overlap, -along, self.mass);
        let spin = self.pair.spin - near.normal * self.pair.spin.dot(&near.normal);
        self.turn(stretch, dt);
        let resistance = (self.pair.rolling, self.pair.equivalent_radius());
        let state = (near.overlap, pressed, self.mass);
        let (couple, held) = self
            .law
            .rolling_couple(resistance, stretch, &spin, dt, state);
        (couple * self.contact.share, held * self.contact.share)
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
