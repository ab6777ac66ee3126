//! Material points on bodies: each point's sphere against the body's rounded
//! surface at the closest feature (docs/method.md, equations 21–24).

use crate::contact::screening::{screening_bodies, screens};
use crate::math::Vec3;
use crate::rigid::{Body, Load};
use crate::walls::{Boundary, Impulse, NodeAccess};
use rayon::prelude::*;
use std::f64::consts::PI;

mod access;
mod around;
mod effective_mass;
mod force;
mod penetration_correction;

pub use access::{Moving, PointAccess};
pub use around::Around;
use effective_mass::{ContactSum, GridCompliance};
use force::{Compliance, PointContact, PointForce};
pub use penetration_correction::{PenetratingPoint, PenetrationCorrection, penetration_correction};

/// Candidates per task.
const TASK: usize = 64;

/// Spheres that represent points in contact with bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointSphere {
    /// Stand-off of a point's centre from a surface in contact, R_p [m].
    pub radius: f64,
    /// Distance of neighbouring points, l [m].
    pub spacing: f64,
}

impl PointSphere {
    /// Bound of the number of points that press on a body from one side, at least one: those on its
    /// bounding ball's projected area or, for a slender body, on half of the surface where their
    /// centres are.
    pub fn most_touching(&self, body: &Body) -> f64 {
        let ball = PI * body.shape.bounding_radius().powi(2);
        let around = 0.5 * body.shape.surface_at(self.radius);
        (ball.min(around) / self.spacing.powi(2)).max(1.0)
    }
}

/// Grid through which points and bodies exchange momentum.
#[derive(Debug)]
pub struct CouplingGrid<'a, N> {
    /// Its nodes.
    pub nodes: &'a N,
    /// Nodes at walls, with their ghost nodes.
    pub boundary: &'a Boundary,
    /// Mirror image of each body, if half of a symmetric flow is computed; else empty.
    pub partners: &'a [usize],
}

/// Instant of a step at which contacts are evaluated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactTime {
    /// Length of the sub-step [s].
    pub dt: f64,
    /// Elapsed share of the step, 0..1.
    pub passed: f64,
}

/// A point that may touch a body within the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate<P> {
    /// Place of the point in memory.
    pub place: P,
    /// Share of the step before which it is too far away to touch.
    earliest: f64,
}

/// Largest distance at which a point at a transfer may touch a body before the next one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Radius of a point's sphere [m].
    pub sphere: f64,
    /// Largest distance by which point and body may come closer [m].
    pub travel: f64,
}

/// Contact forces of one sub-step, on points at places `P`.
#[derive(Debug)]
pub struct Loads<P> {
    /// Loads of the flow on every body.
    pub on_bodies: Vec<FlowLoad>,
    /// Points in contact and the force on them [N]; a point in contact with several bodies occurs
    /// several times.
    pub on_points: Vec<(P, Vec3)>,
    /// Per body, the points that may touch it within the step.
    pub candidates: Vec<Vec<Candidate<P>>>,
    /// Points in a body's box.
    near: Vec<P>,
    /// Per body, the others that may lie between it and a point.
    screening: Vec<Vec<usize>>,
    /// Per body, the contacts of its candidates.
    contacts: Vec<Vec<Option<PointContact>>>,
    /// Per body, their sum.
    sums: Vec<ContactSum>,
    compliance: GridCompliance,
}

impl<P> Default for Loads<P> {
    fn default() -> Self {
        Self {
            on_bodies: Vec::new(),
            on_points: Vec::new(),
            candidates: Vec::new(),
            near: Vec::new(),
            screening: Vec::new(),
            contacts: Vec::new(),
            sums: Vec::new(),
            compliance: GridCompliance::default(),
        }
    }
}

/// Load of the flow on one body.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FlowLoad {
    /// Force, and torque about the centre of mass.
    pub load: Load,
    /// Points in touch.
    pub touching_points: u32,
    /// Largest overlap δ/(R_p + r).
    pub deepest_overlap_ratio: f64,
    /// Energy stored in the contacts [J].
    pub energy: f64,
}

impl<P> Loads<P> {
    /// Bytes of a candidate and its contact.
    pub const CANDIDATE_BYTES: usize =
        size_of::<P>() + size_of::<Candidate<P>>() + size_of::<Option<PointContact>>();

    /// Bytes allocated for candidates, their contacts and the compliance of nodes.
    pub fn bytes(&self) -> usize {
        let candidates: usize = self.candidates.iter().map(Vec::capacity).sum();
        let contacts: usize = self.contacts.iter().map(Vec::capacity).sum();
        self.near.capacity() * size_of::<P>()
            + candidates * size_of::<Candidate<P>>()
            + contacts * size_of::<Option<PointContact>>()
            + self.compliance.bytes()
    }
}

impl<P: Copy + Send + Sync> Loads<P> {
    /// Prepares a step: finds the points within reach of each body.
    pub fn find_candidates(
        &mut self,
        points: &impl PointAccess<Place = P>,
        bodies: &[Body],
        reach: Reach,
    ) {
        self.on_points.clear();
        self.on_bodies.clear();
        self.on_bodies.resize(bodies.len(), FlowLoad::default());
        self.candidates.resize_with(bodies.len(), Vec::new);
        screening_bodies(bodies, reach.sphere + reach.travel, &mut self.screening);
        let near = &mut self.near;
        for (body, candidates) in bodies.iter().zip(&mut self.candidates) {
            near.clear();
            points.find_within(&Around::body(body, reach.sphere + reach.travel), near);
            candidates.clear();
            candidates.extend(near.iter().filter_map(|place| {
                let arm = points.resting(*place) - body.state.position;
                let closest = body.shape.closest_feature(&body.to_body(&arm));
                let gap = closest.distance - reach.sphere - body.shape.sphero_radius();
                let earliest = gap / reach.travel;
                let place = *place;
                (earliest <= 1.0).then_some(Candidate { place, earliest })
            }));
        }
    }

    /// Evaluates the contact forces at the points' current positions and velocities.
    pub fn evaluate<N: NodeAccess>(
        &mut self,
        points: &impl PointAccess<Place = P>,
        grid: &CouplingGrid<'_, N>,
        bodies: &[Body],
        sphere: PointSphere,
        time: ContactTime,
    ) {
        self.find_contacts(points, bodies, sphere.radius, time.passed);
        let contacts = self.contacts.iter().flatten().flatten();
        let stencils = contacts.map(|contact| &contact.stencil);
        self.compliance.gather(stencils, grid.nodes, grid.boundary);
        self.sum_contacts(grid.partners);
        self.add_forces(bodies, time.dt);
    }

    fn find_contacts(
        &mut self,
        points: &impl PointAccess<Place = P>,
        bodies: &[Body],
        stand_off: f64,
        passed: f64,
    ) {
        self.contacts.resize_with(bodies.len(), Vec::new);
        bodies
            .par_iter()
            .zip(&self.candidates)
            .zip(&self.screening)
            .zip(&mut self.contacts)
            .for_each(|(((body, candidates), screening), contacts)| {
                let find = |candidate: &Candidate<P>| {
                    let in_reach = candidate.earliest <= passed;
                    in_reach
                        .then(|| PointContact::find(points, candidate.place, body, stand_off))
                        .flatten()
                        .filter(|contact| {
                            screening.is_empty() || {
                                let (from, to) = contact.ends(body, stand_off);
                                let mut between = screening.iter();
                                !between.any(|other| screens(&bodies[*other], &from, &to))
                            }
                        })
                };
                candidates
                    .par_iter()
                    .with_min_len(TASK)
                    .map(find)
                    .collect_into_vec(contacts);
            });
    }

    /// Sums the contacts of every body, those of its mirror image included.
    fn sum_contacts(&mut self, partners: &[usize]) {
        let of_body = |body: usize| {
            let mut sum = ContactSum::default();
            for contact in self.contacts[body].iter().flatten() {
                sum.add(contact.turning);
            }
            sum
        };
        self.sums.clear();
        self.sums.extend(
            (0..self.contacts.len()).map(|body| match partners.get(body) {
                Some(partner) => of_body(body).plus(of_body(*partner)),
                None => of_body(body),
            }),
        );
    }

    /// Adds the forces in the order of the bodies and their candidates.
    fn add_forces(&mut self, bodies: &[Body], dt: f64) {
        self.on_points.clear();
        let of_bodies = self.candidates.iter().zip(&self.contacts);
        let on_bodies = bodies.iter().zip(&self.sums).zip(&mut self.on_bodies);
        for ((candidates, contacts), ((body, sum), on_body)) in of_bodies.zip(on_bodies) {
            *on_body = FlowLoad::default();
            let of_body = sum.compliance(body);
            for (candidate, contact) in candidates.iter().zip(contacts) {
                let Some(contact) = contact else { continue };
                let of_body = of_body.at(contact.turning);
                let compliance = Compliance {
                    body: of_body,
                    total: self.compliance.at(&contact.stencil) + of_body,
                };
                let force = contact.force(&body.flow_law, compliance, dt);
                on_body.take_in(&force);
                self.on_points.push((candidate.place, force.force));
            }
        }
    }
}

/// Impulse of the selected bodies on the flow in `dt`, from the loads of the flow on all of
/// them.
pub fn impulse_on_flow(
    on_bodies: &[FlowLoad],
    bodies: &[Body],
    dt: f64,
    picks: impl Fn(&Body) -> bool,
) -> Impulse {
    let mut impulse = Impulse::default();
    for (body, flow) in bodies.iter().zip(on_bodies) {
        if picks(body) {
            impulse.add_at(&body.state.position, &(flow.load.force * -dt));
            impulse.angular -= flow.load.torque * dt;
        }
    }
    impulse
}

impl FlowLoad {
    fn take_in(&mut self, contact: &PointForce) {
        self.load.add_at(&contact.arm, &-contact.force);
        self.touching_points += 1;
        self.deepest_overlap_ratio = self.deepest_overlap_ratio.max(contact.overlap_ratio);
        self.energy += contact.energy;
    }
}

#[cfg(test)]
mod tests;
