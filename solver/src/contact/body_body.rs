//! Bodies on bodies: what two of them do to each other, and what their
//! contacts remember (docs/method.md, equations 43–47).

use crate::contact::law::{ContactLaw, mass_seen};
use crate::math::Vec3;
use crate::rigid::{Body, Freedom, Load};
use serde::{Deserialize, Serialize};

mod places;
mod segments;
mod separation;

use places::{Between, Contact, contacts};
pub use separation::{Separation, least_gap};

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

    /// Renews springs and forces after a drift of `dt`, and what is known of the gap.
    pub fn touch(
        &mut self,
        [first, second]: [&Body; 2],
        law: &ContactLaw,
        dt: f64,
        separation: &mut Separation,
    ) -> Exchange {
        let found = contacts(first, second, law, separation);
        let pair = Pair::new(first, second, &found.push);
        let before = std::mem::take(&mut self.springs);
        let mut push = found.push;
        self.energy = found.energy;
        self.deepest = 0.0;
        for contact in &found.places {
            let mut spring = remembered(&before, contact, pair.radii);
            let felt = pair.felt(contact, law);
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
        Exchange::of(&push, &pair.apart)
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
    velocities: [Motion; 2],
    /// What the elastic forces of all contacts give.
    accelerations: [Motion; 2],
    reduced_mass: f64,
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
    fn new(first: &'a Body, second: &'a Body, push: &Load) -> Self {
        let apart = second.state.position - first.state.position;
        let exchange = Exchange::of(push, &apart);
        Self {
            bodies: [first, second],
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
    fn relative(&self, [first, second]: &[Motion; 2], place: &Vec3) -> Vec3 {
        second.at(&(place - self.apart)) - first.at(place)
    }

    /// R* of 1/R* = 1/r_a + 1/r_b [m].
    fn equivalent_radius(&self) -> f64 {
        let [a, b] = self.bodies.map(|body| body.shape.sphero_radius());
        a * b / (a + b)
    }

    fn felt(&'a self, contact: &'a Contact, law: &'a ContactLaw) -> Felt<'a> {
        let near = &contact.near;
        let parting = self.relative(&self.accelerations, &near.place);
        Felt {
            contact,
            law,
            velocity: self.relative(&self.velocities, &near.place),
            mass: mass_seen(
                law.elastic_force(near.overlap),
                parting.dot(&near.normal),
                self.reduced_mass,
            ),
            pair: self,
        }
    }
}

impl Exchange {
    /// When the second body is pushed, the torque being about the first's centre;
    /// `apart` is the way from there to the second's.
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
        *stretch += self.pair.turning().cross(stretch) * dt;
        *stretch -= normal * stretch.dot(normal);
    }

    /// Couple against rolling on the second body [N m], and the energy its spring
    /// holds [J].
    fn resist_rolling(&self, stretch: &mut Vec3, dt: f64) -> (Vec3, f64) {
        let near = &self.contact.near;
        let along = self.velocity.dot(&near.normal);
        let pressed = self.law.normal_force(near.overlap, -along, self.mass);
        let spin = self.pair.spin();
        let spin = spin - near.normal * spin.dot(&near.normal);
        self.turn(stretch, dt);
        let resistance = (self.pair.rolling, self.pair.equivalent_radius());
        let state = (near.overlap, pressed, self.mass);
        let (couple, held) = self
            .law
            .rolling_couple(resistance, stretch, &spin, dt, state);
        (couple * self.contact.share, held * self.contact.share)
    }
}

/// How a body moves, or begins to: at its centre, and turning.
struct Motion {
    linear: Vec3,
    angular: Vec3,
}

impl Motion {
    const NONE: Self = Self {
        linear: Vec3::new(0.0, 0.0, 0.0),
        angular: Vec3::new(0.0, 0.0, 0.0),
    };

    /// A fixed body has none.
    fn velocity(body: &Body) -> Self {
        match body.freedom {
            Freedom::Fixed => Self::NONE,
            Freedom::Free | Freedom::InPlane | Freedom::Prescribed(_) => Self {
                linear: body.velocity(),
                angular: body.angular_velocity(),
            },
        }
    }

    /// What a load gives a body that does not turn yet.
    fn acceleration(body: &Body, load: &Load) -> Self {
        match body.freedom {
            Freedom::Fixed | Freedom::Prescribed(_) => Self::NONE,
            Freedom::Free | Freedom::InPlane => Self {
                linear: load.force / body.mass,
                angular: body.angular_acceleration(&load.torque),
            },
        }
    }

    fn at(&self, arm: &Vec3) -> Vec3 {
        self.linear + self.angular.cross(arm)
    }
}

/// Mass of the motion of two bodies towards each other [kg]; of two that no load moves none.
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
