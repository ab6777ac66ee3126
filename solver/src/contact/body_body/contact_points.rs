//! Contact points of two cores, each place once: the terms of the contact potential of two
//! bodies and its gradient (docs/method.md, equations 43 and 44; docs/decisions/0010).

use super::segments::{crossing, nearest_on};
use super::separation::{Separation, corners};
use crate::contact::law::ContactLaw;
use crate::math::Vec3;
use crate::rigid::{Body, Load};
use serde::{Deserialize, Serialize};

/// Distance over R below which two places have no defined direction.
const NO_DIRECTION: f64 = 1e-9;

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
}

/// Finds all contacts of two bodies, trying first the direction that separated them before.
pub(super) fn contacts(
    first: &Body,
    second: &Body,
    law: &ContactLaw,
    separation: &mut Separation,
) -> Contacts {
    let mut found = Contacts::default();
    let Some(pair) = Pair::near(first, second, separation) else {
        return found;
    };
    for &(vertex, place) in &pair.first.vertices {
        if let Some(near) = pair.of_first(&place) {
            found.take(law, FeaturePair::VertexOfFirst(vertex), near, &[]);
        }
    }
    for &(vertex, place) in &pair.second.vertices {
        if let Some(near) = pair.of_second(&place) {
            let twins = pair.first.vertices.iter();
            let twins = twins.filter_map(|(_, other)| pair.between(other, &place));
            found.take(
                law,
                FeaturePair::VertexOfSecond(vertex),
                near,
                &twins.collect::<Vec<_>>(),
            );
        }
    }
    for (e, on_first) in &pair.first.edges {
        let reached = Bounds::of(on_first).grown(pair.radii[0] + pair.radii[1]);
        for (f, on_second) in &pair.second.edges {
            if !reached.meets(on_second) {
                continue;
            }
            let Some((p, q)) = crossing(on_first, on_second) else {
                continue;
            };
            if let Some(near) = pair.between(&p, &q) {
                let ends = pair.ends(on_first, on_second);
                found.take(law, FeaturePair::Edges(*e, *f), near, &ends);
            }
        }
    }
    found
}

impl Contacts {
    /// Adds the part of a contact's energy that the `booked` contacts nearby do not account for.
    fn take(
        &mut self,
        law: &ContactLaw,
        between: FeaturePair,
        near: ContactPoint,
        booked: &[ContactPoint],
    ) {
        let energy = law.elastic_energy(near.overlap);
        if energy <= 0.0 {
            return;
        }
        // Rounding can make a booked distance the smaller one.
        let ratio = |other: &ContactPoint| (law.elastic_energy(other.overlap) / energy).min(1.0);
        let ratios: Vec<f64> = booked.iter().map(ratio).collect();
        let without = |left_out: usize| -> f64 {
            let others = ratios.iter().enumerate();
            let others = others.filter(|(place, _)| *place != left_out);
            others.map(|(_, ratio)| 1.0 - ratio).product()
        };
        let share = without(ratios.len());
        let mut coefficient = share;
        for (place, (other, ratio)) in booked.iter().zip(&ratios).enumerate() {
            let rest = without(place);
            coefficient += ratio * rest;
            self.pushed(other, -rest * law.elastic_force(other.overlap));
        }
        self.pushed(&near, coefficient * law.elastic_force(near.overlap));
        self.energy += share * energy;
        if share > 0.0 {
            self.places.push(Contact {
                between,
                near,
                share,
            });
        }
    }

    fn pushed(&mut self, at: &ContactPoint, force: f64) {
        self.push.add_at(&at.place, &(at.normal * force));
    }
}

/// Features of a core that may touch the other, in world axes, from the first body's centre
/// [m].
#[derive(Debug, Default)]
struct Nearby {
    vertices: Vec<(usize, Vec3)>,
    edges: Vec<(usize, [Vec3; 2])>,
}

/// Two bodies that no direction looked at separates.
struct Pair<'a> {
    bodies: [&'a Body; 2],
    /// Vector from the first body's centre to the second's.
    apart: Vec3,
    /// Sphero radii.
    radii: [f64; 2],
    first: Nearby,
    second: Nearby,
}

impl<'a> Pair<'a> {
    fn near(first: &'a Body, second: &'a Body, separation: &mut Separation) -> Option<Self> {
        let bodies = [first, second];
        let apart = second.state.position - first.state.position;
        let radii = bodies.map(|body| body.shape.sphero_radius());
        let corners = [corners(first, &Vec3::zeros()), corners(second, &apart)];
        let widest = separation.look(bodies, &apart, &corners);
        let reach = radii[0] + radii[1];
        separation.gap = widest.width - reach;
        if separation.gap >= 0.0 {
            return None;
        }
        let [of_first, of_second] = &corners;
        // Features farther than `reach` from the beginning of the other core, in the direction of
        // the widest gap or along an axis, can't touch.
        let on_first = |x: &Vec3| widest.second_from - widest.direction.dot(x) < reach;
        let on_second = |x: &Vec3| widest.direction.dot(x) - widest.first_to < reach;
        Some(Self {
            first: nearby(
                first,
                of_first,
                &Bounds::of(of_second).grown(reach),
                on_first,
            ),
            second: nearby(
                second,
                of_second,
                &Bounds::of(of_first).grown(reach),
                on_second,
            ),
            bodies,
            apart,
            radii,
        })
    }

    /// Nearest places of a vertex of the first body and the second's core.
    fn of_first(&self, vertex: &Vec3) -> Option<ContactPoint> {
        let second = self.bodies[1];
        let closest = second
            .shape
            .closest_feature(&second.to_body(&(vertex - self.apart)));
        let normal = -second.to_world(&closest.normal);
        self.overlapping_pairs(vertex, &normal, closest.distance)
    }

    /// Nearest places of a vertex of the second body and the first's core.
    fn of_second(&self, vertex: &Vec3) -> Option<ContactPoint> {
        let first = self.bodies[0];
        let closest = first.shape.closest_feature(&first.to_body(vertex));
        let normal = first.to_world(&closest.normal);
        let on_first = vertex - normal * closest.distance;
        self.overlapping_pairs(&on_first, &normal, closest.distance)
    }

    /// Contact point of a place of the first core and one of the second.
    fn between(&self, on_first: &Vec3, on_second: &Vec3) -> Option<ContactPoint> {
        let gap = on_second - on_first;
        let distance = gap.norm();
        if distance <= NO_DIRECTION * (self.radii[0] + self.radii[1]) {
            return None;
        }
        self.overlapping_pairs(on_first, &(gap / distance), distance)
    }

    fn overlapping_pairs(
        &self,
        on_first: &Vec3,
        normal: &Vec3,
        distance: f64,
    ) -> Option<ContactPoint> {
        let overlap = self.radii[0] + self.radii[1] - distance;
        (overlap > 0.0).then(|| ContactPoint {
            normal: *normal,
            place: on_first + normal * (self.radii[0] - 0.5 * overlap),
            overlap,
        })
    }

    /// The ends of two edges against the other edge, those in contact.
    fn ends(&self, on_first: &[Vec3; 2], on_second: &[Vec3; 2]) -> Vec<ContactPoint> {
        let of_first = on_first
            .iter()
            .filter_map(|end| self.between(end, &nearest_on(on_second, end)));
        let of_second = on_second
            .iter()
            .filter_map(|end| self.between(&nearest_on(on_first, end), end));
        of_first.chain(of_second).collect()
    }
}

fn nearby(
    body: &Body,
    corners: &[Vec3],
    reached: &Bounds,
    in_reach: impl Fn(&Vec3) -> bool,
) -> Nearby {
    let vertices = corners.iter().copied().enumerate();
    let vertices = vertices.filter(|(_, place)| in_reach(place) && reached.meets(&[*place]));
    let edges = body.shape.edges().enumerate();
    let edges = edges.filter_map(|(number, edge)| {
        let ends = edge.vertices.map(|vertex| corners[vertex]);
        let near = ends.iter().any(&in_reach) && reached.meets(&ends);
        near.then_some((number, ends))
    });
    Nearby {
        vertices: vertices.collect(),
        edges: edges.collect(),
    }
}

/// An axis-aligned box.
struct Bounds {
    low: Vec3,
    high: Vec3,
}

impl Bounds {
    fn of(places: &[Vec3]) -> Self {
        let start = Vec3::repeat(f64::INFINITY);
        Self {
            low: places.iter().fold(start, |low, x| low.inf(x)),
            high: places.iter().fold(-start, |high, x| high.sup(x)),
        }
    }

    fn grown(mut self, by: f64) -> Self {
        self.low -= Vec3::repeat(by);
        self.high += Vec3::repeat(by);
        self
    }

    /// True if the bounding box of `places` overlaps this one.
    fn meets(&self, places: &[Vec3]) -> bool {
        let other = Self::of(places);
        (0..3).all(|axis| other.low[axis] < self.high[axis] && other.high[axis] > self.low[axis])
    }
}
