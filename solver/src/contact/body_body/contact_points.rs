//! Contact points of two cores, each place once: the terms of the contact potential of two
//! bodies and its gradient (docs/method.md, equations 43 and 44; docs/decisions/0010).

use super::Pressed;
use super::history::FeatureSprings;
use super::segments::{crossing, nearest_on};
use super::separation::{Separation, put_corners};
use crate::contact::law::ContactLaw;
use crate::math::Vec3;
use crate::rigid::{Body, Load};
use serde::{Deserialize, Serialize};

/// Distance over R below which two places have no defined direction.
const NO_DIRECTION: f64 = 1e-9;

/// Distance of two edges over R up to which they are looked at: clearances beyond it are as good as
/// this one.
const LOOKED_AT: f64 = 1.0 + 1e-2;

/// Two features that may touch, by their numbers in the cores.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum FeaturePair {
    /// A vertex of the first body and the second's core.
    VertexOfFirst(usize),
    /// A vertex of the second body and the first's core.
    VertexOfSecond(usize),
    /// An edge of the first and one of the second that cross.
    Edges(usize, usize),
}

/// Nearest places of two features whose roundings overlap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ContactPoint {
    /// Unit vector from the first body to the second.
    pub(super) normal: Vec3,
    /// Middle of the overlap, from the first body's centre [m].
    pub(super) place: Vec3,
    /// Overlap δ [m].
    pub(super) overlap: f64,
}

/// A contact of two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Contact {
    /// The features in contact.
    pub(super) between: FeaturePair,
    /// Their contact point.
    pub(super) near: ContactPoint,
    /// Share of its force that remains after other contacts took their part, above 0, at most 1.
    pub(super) share: f64,
}

/// All contacts of two bodies, and their total elastic force.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Contacts {
    /// The contacts, in an order that depends on the bodies alone.
    pub(super) places: Vec<Contact>,
    /// Elastic force on the second body, and its torque about the *first's*
    /// centre: minus the gradient of the potential.
    pub(super) push: Load,
    /// The potential U [J].
    pub(super) energy: f64,
    /// Least distance of the features that were looked at and do not touch [m].
    pub(super) clearance: f64,
    /// Parts of the last contact taken that others account for; kept to avoid allocations, like the
    /// next two.
    booked: Vec<Booked>,
    /// Normal forces of the contacts.
    pub(super) pressed: Vec<Pressed>,
    /// Springs of the contacts before.
    pub(super) springs: Vec<FeatureSprings>,
}

/// A contact that accounts for a part of another one's energy.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Booked {
    near: ContactPoint,
    /// The part over the whole, at most 1.
    ratio: f64,
}

/// Finds all contacts of two bodies, with what is known of them from before.
pub(super) fn contacts(
    bodies: [&Body; 2],
    law: &ContactLaw,
    separation: &mut Separation,
    found: &mut Contacts,
) {
    found.clear();
    let pair = Pair::of(bodies);
    put_corners(bodies, &pair.apart, &mut separation.corners);
    // Bodies that touched are seldom apart now.
    if separation.touched && separation.near.are_listed() {
        pair.find(law, separation, found);
        separation.touched = !found.places.is_empty();
        if !separation.touched {
            separation.look(bodies, &pair.apart);
        }
        return;
    }
    let gap = separation.look(bodies, &pair.apart);
    if separation.gap >= 0.0 {
        separation.touched = false;
        return;
    }
    if !separation.near.are_listed() {
        let Separation { near, corners, .. } = separation;
        near.list(bodies, corners, &gap);
    }
    pair.find(law, separation, found);
    separation.touched = !found.places.is_empty();
}

impl Contacts {
    /// Forgets all contacts.
    pub fn clear(&mut self) {
        self.places.clear();
        self.push = Load::default();
        self.energy = 0.0;
        self.clearance = f64::INFINITY;
    }

    /// Counts two features this far apart [m]; true if they touch.
    fn touch_at(&mut self, apart: f64) -> bool {
        let touch = apart < 0.0;
        if !touch {
            self.clearance = self.clearance.min(apart);
        }
        touch
    }

    /// Adds the part of a contact's energy that the `booked` contacts nearby do not account for.
    fn take(
        &mut self,
        law: &ContactLaw,
        between: FeaturePair,
        near: ContactPoint,
        booked: impl Iterator<Item = ContactPoint>,
    ) {
        let energy = law.elastic_energy(near.overlap);
        if energy <= 0.0 {
            return;
        }
        self.booked.clear();
        self.booked.extend(booked.map(|near| Booked {
            near,
            // Rounding can make a booked distance the smaller one.
            ratio: (law.elastic_energy(near.overlap) / energy).min(1.0),
        }));
        let booked = &self.booked;
        let without = |left_out: usize| -> f64 {
            let others = booked.iter().enumerate();
            let others = others.filter(|(place, _)| *place != left_out);
            others.map(|(_, other)| 1.0 - other.ratio).product()
        };
        let share = without(booked.len());
        let mut coefficient = share;
        for (place, other) in booked.iter().enumerate() {
            let rest = without(place);
            coefficient += other.ratio * rest;
            let force = -rest * law.elastic_force(other.near.overlap);
            other.near.pushes(force, &mut self.push);
        }
        near.pushes(
            coefficient * law.elastic_force(near.overlap),
            &mut self.push,
        );
        self.energy += share * energy;
        if share > 0.0 {
            self.places.push(Contact {
                between,
                near,
                share,
            });
        }
    }
}

impl ContactPoint {
    /// Adds a force along its normal to the push on the second body.
    fn pushes(&self, force: f64, push: &mut Load) {
        push.add_at(&self.place, &(self.normal * force));
    }
}

/// Two bodies that may touch.
struct Pair<'a> {
    bodies: [&'a Body; 2],
    /// Vector from the first body's centre to the second's.
    apart: Vec3,
    /// Sphero radii.
    radii: [f64; 2],
}

impl<'a> Pair<'a> {
    fn of(bodies: [&'a Body; 2]) -> Self {
        Self {
            bodies,
            apart: bodies[1].state.position - bodies[0].state.position,
            radii: bodies.map(|body| body.shape.sphero_radius()),
        }
    }

    /// Finds the contacts of the features listed.
    fn find(&self, law: &ContactLaw, separation: &Separation, found: &mut Contacts) {
        let Separation {
            near,
            corners: [of_first, of_second],
            ..
        } = separation;
        for &vertex in &near.vertices[0] {
            if let Some(near) = self.of_first(&of_first[vertex], found) {
                let between = FeaturePair::VertexOfFirst(vertex);
                found.take(law, between, near, std::iter::empty());
            }
        }
        for &vertex in &near.vertices[1] {
            let place = &of_second[vertex];
            if let Some(touching) = self.of_second(place, found) {
                let twins = near.vertices[0].iter();
                let twins = twins.filter_map(|&twin| self.between(&of_first[twin], place));
                let between = FeaturePair::VertexOfSecond(vertex);
                found.take(law, between, touching, twins);
            }
        }
        let reach = LOOKED_AT * (self.radii[0] + self.radii[1]);
        found.touch_at(self.gap(reach));
        for pair in &near.edges {
            let on_first = pair.ends[0].map(|end| of_first[end]);
            let on_second = pair.ends[1].map(|end| of_second[end]);
            let Some((p, q)) = crossing(&on_first, &on_second, reach) else {
                continue;
            };
            if !found.touch_at(self.gap((q - p).norm())) {
                continue;
            }
            if let Some(near) = self.between(&p, &q) {
                let [e, f] = pair.numbers;
                let ends = self.ends(&on_first, &on_second);
                found.take(law, FeaturePair::Edges(e, f), near, ends);
            }
        }
    }

    /// Nearest places of a vertex of the first body and the second's core.
    fn of_first(&self, vertex: &Vec3, found: &mut Contacts) -> Option<ContactPoint> {
        let second = self.bodies[1];
        let closest = second
            .shape
            .closest_feature(&second.to_body(&(vertex - self.apart)));
        found.touch_at(self.gap(closest.distance)).then(|| {
            let normal = -second.to_world(&closest.normal);
            self.touching(vertex, &normal, closest.distance)
        })
    }

    /// Nearest places of a vertex of the second body and the first's core.
    fn of_second(&self, vertex: &Vec3, found: &mut Contacts) -> Option<ContactPoint> {
        let first = self.bodies[0];
        let closest = first.shape.closest_feature(&first.to_body(vertex));
        found.touch_at(self.gap(closest.distance)).then(|| {
            let normal = first.to_world(&closest.normal);
            let on_first = vertex - normal * closest.distance;
            self.touching(&on_first, &normal, closest.distance)
        })
    }

    /// Contact point of a place of the first core and one of the second.
    fn between(&self, on_first: &Vec3, on_second: &Vec3) -> Option<ContactPoint> {
        let gap = on_second - on_first;
        let distance = gap.norm();
        let defined = distance > NO_DIRECTION * (self.radii[0] + self.radii[1]);
        (defined && self.gap(distance) < 0.0)
            .then(|| self.touching(on_first, &(gap / distance), distance))
    }

    /// Distance of the roundings of places at this distance; negative if they overlap.
    fn gap(&self, distance: f64) -> f64 {
        distance - (self.radii[0] + self.radii[1])
    }

    fn touching(&self, on_first: &Vec3, normal: &Vec3, distance: f64) -> ContactPoint {
        let overlap = self.radii[0] + self.radii[1] - distance;
        ContactPoint {
            normal: *normal,
            place: on_first + normal * (self.radii[0] - 0.5 * overlap),
            overlap,
        }
    }

    /// The ends of two edges against the other edge, those in contact.
    fn ends(
        &self,
        on_first: &[Vec3; 2],
        on_second: &[Vec3; 2],
    ) -> impl Iterator<Item = ContactPoint> {
        let of_first = on_first
            .iter()
            .filter_map(|end| self.between(end, &nearest_on(on_second, end)));
        let of_second = on_second
            .iter()
            .filter_map(|end| self.between(&nearest_on(on_first, end), end));
        of_first.chain(of_second)
    }
}
