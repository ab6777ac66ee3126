//! Material points on bodies: each point's sphere against the body's rounded
//! surface at the closest feature (docs/method.md, equations 21–24).

use crate::grid::{BLOCK, BlockKey};
use crate::kernel::Lattice;
use crate::math::Vec3;
use crate::rigid::{Body, Freedom, Load};
use crate::shape::Face;
use crate::walls::{Impulse, Plane};
use rayon::prelude::*;

/// Candidates one task looks at.
const TASK: usize = 64;

/// What the points are to a body: spheres of one size, with the impedance of
/// the material they stand for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointSphere {
    /// Radius R_p [m] (equation P3).
    pub radius: f64,
    /// Largest damping coefficient, ρ c_p l² [N s/m]: what a plane P-wave of
    /// the material resists on one point's cross-section. More would brake the
    /// flow before it touches.
    pub impedance: f64,
    /// Distance of neighbouring points, l [m].
    pub spacing: f64,
}

/// Share of a free body's momentum relative to the flow that damping and
/// friction of all points that can touch it may take per sub-step: a light body
/// is carried along, not thrown.
const LARGEST_BRAKING: f64 = 0.5;

impl PointSphere {
    /// Points that find room on a body's largest shadow, at least one.
    pub fn most_touching(&self, body: &Body) -> f64 {
        let radius = body.shape.shadow_radius();
        (std::f64::consts::PI * (radius / self.spacing).powi(2)).max(1.0)
    }

    /// Largest damping coefficient of one point on this body [N s/m].
    fn braking(&self, body: &Body, dt: f64) -> f64 {
        match body.freedom {
            Freedom::Fixed | Freedom::Prescribed(_) => self.impedance,
            Freedom::Free | Freedom::InPlane => {
                let share = LARGEST_BRAKING * body.mass / (self.most_touching(body) * dt);
                self.impedance.min(share)
            }
        }
    }
}

/// The points of a flow as bodies meet them within a step.
pub trait PointAccess: Sync {
    /// Where a point is kept, from one transfer to the next.
    type Place: Copy + Send + Sync;
    /// Finds the points that were within a box at the transfer.
    fn find_within(&self, around: &Around, found: &mut Vec<Self::Place>);
    /// Where a point was at the transfer [m].
    fn resting(&self, place: Self::Place) -> Vec3;
    /// A point as it is now.
    fn moving(&self, place: Self::Place) -> Moving;
}

/// A point amid a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moving {
    /// Present position [m].
    pub position: Vec3,
    /// Present velocity [m/s].
    pub velocity: Vec3,
    /// Mass [kg].
    pub mass: f64,
}

/// A point that may touch a body within the step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate<P> {
    /// Where the point is kept.
    pub place: P,
    /// Share of the step before which it is too far off to touch.
    earliest: f64,
}

/// How far off a point can be at a transfer and still touch a body before the
/// next one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Radius of a point's sphere [m].
    pub sphere: f64,
    /// Largest distance by which point and body may come closer [m].
    pub travel: f64,
}

/// Contact forces of one sub-step, on points that are kept at places `P`.
#[derive(Debug)]
pub struct Loads<P> {
    /// What the flow does to every body.
    pub on_bodies: Vec<FlowLoad>,
    /// Points in touch and the force on them [N]; one of several bodies comes
    /// several times.
    pub on_points: Vec<(P, Vec3)>,
    /// Per body, the points that may touch it within the step.
    pub candidates: Vec<Vec<Candidate<P>>>,
    /// Points in a body's box.
    near: Vec<P>,
    /// Per body, what became of them.
    met: Vec<Vec<Option<Touch>>>,
}

impl<P> Default for Loads<P> {
    fn default() -> Self {
        Self {
            on_bodies: Vec::new(),
            on_points: Vec::new(),
            candidates: Vec::new(),
            near: Vec::new(),
            met: Vec::new(),
        }
    }
}

/// What the flow does to one body.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FlowLoad {
    /// Force, and torque about the centre of mass.
    pub load: Load,
    /// Points in touch.
    pub touching_points: u32,
    /// Largest overlap δ/(R_p + r).
    pub deepest_overlap_ratio: f64,
    /// Energy the contacts hold [J].
    pub energy: f64,
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

    /// Contact forces at the points' present positions and velocities, `passed`
    /// of the step (0..1) being over.
    pub fn evaluate(
        &mut self,
        points: &impl PointAccess<Place = P>,
        bodies: &[Body],
        sphere: PointSphere,
        dt: f64,
        passed: f64,
    ) {
        self.met.resize_with(bodies.len(), Vec::new);
        bodies
            .par_iter()
            .zip(&self.candidates)
            .zip(&mut self.met)
            .for_each(|((body, candidates), met)| {
                met.resize(candidates.len(), None);
                let meeting = Meeting {
                    body,
                    radius: sphere.radius,
                    braking: sphere.braking(body, dt),
                };
                candidates
                    .par_iter()
                    .zip(met)
                    .with_min_len(TASK)
                    .for_each(|(candidate, met)| {
                        let in_reach = candidate.earliest <= passed;
                        *met = in_reach
                            .then(|| meeting.touch(&points.moving(candidate.place)))
                            .flatten();
                    });
            });
        self.add_up();
    }

    /// Sums in the order of the bodies and their candidates.
    fn add_up(&mut self) {
        self.on_points.clear();
        let of_bodies = self.candidates.iter().zip(&self.met);
        for ((candidates, met), on_body) in of_bodies.zip(&mut self.on_bodies) {
            *on_body = FlowLoad::default();
            for (candidate, touch) in candidates.iter().zip(met) {
                if let Some(touch) = touch {
                    on_body.take_in(touch);
                    self.on_points.push((candidate.place, touch.force));
                }
            }
        }
    }
}

/// Impulse that the bodies picked give the flow in `dt`, by what
/// the flow does to all of them.
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
    fn take_in(&mut self, touch: &Touch) {
        self.load.add_at(&touch.arm, &-touch.force);
        self.touching_points += 1;
        self.deepest_overlap_ratio = self.deepest_overlap_ratio.max(touch.overlap_ratio);
        self.energy += touch.energy;
    }
}

/// A point and a body in touch.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Touch {
    /// From the body's centre to the point [m].
    arm: Vec3,
    /// On the point [N].
    force: Vec3,
    /// δ/(R_p + r).
    overlap_ratio: f64,
    /// Energy the contact holds [J].
    energy: f64,
}

/// How a body meets spheres of points.
struct Meeting<'a> {
    body: &'a Body,
    radius: f64,
    /// Largest damping coefficient [N s/m].
    braking: f64,
}

impl Meeting<'_> {
    /// What the body does to a point; `None` if apart.
    fn touch(&self, point: &Moving) -> Option<Touch> {
        let body = self.body;
        let arm = point.position - body.state.position;
        let closest = body.shape.closest_feature(&body.to_body(&arm));
        let reach = self.radius + body.shape.sphero_radius();
        let overlap = reach - closest.distance;
        if overlap <= 0.0 {
            return None;
        }
        let normal = body.to_world(&closest.normal);
        let relative = point.velocity - body.velocity_at(&arm);
        let along = relative.dot(&normal);
        let law = &body.flow_law;
        let damping = law
            .damping_coefficient(overlap, point.mass)
            .min(self.braking);
        let pressed = (law.elastic_force(overlap) - damping * along).max(0.0);
        let sliding = relative - normal * along;
        let slip = sliding.norm().max(f64::MIN_POSITIVE);
        let friction = self.braking.min(law.friction * pressed / slip);
        Some(Touch {
            arm,
            force: normal * pressed - sliding * friction,
            overlap_ratio: overlap / reach,
            energy: law.elastic_energy(overlap),
        })
    }
}

/// What becomes of a point that ended a step inside a body's core.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PutBack {
    /// It belongs there.
    To(Vec3),
    /// It is so deep [m], and walls leave no room over any face.
    NoRoom {
        /// Below the nearest face of the core [m].
        depth: f64,
    },
}

/// A point that stays inside a body's core.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stuck {
    /// Identity of the point.
    pub point: u32,
    /// Index of the body.
    pub body: usize,
    /// Depth below the nearest face of the core [m].
    pub depth: f64,
}

impl Stuck {
    /// The deeper one of two.
    pub fn deeper(first: Option<Self>, second: Self) -> Option<Self> {
        Some(
            first
                .filter(|one| one.depth >= second.depth)
                .unwrap_or(second),
        )
    }
}

/// Where a point belongs that ended a step inside a body's core: over the nearest
/// face above which there is room between the `walls`. `None` if it is outside.
pub fn put_back(position: &Vec3, body: &Body, walls: &[Plane]) -> Option<PutBack> {
    let arm = body.to_body(&(position - body.state.position));
    let distance = body.shape.closest_feature(&arm).distance;
    if distance >= 0.0 {
        return None;
    }
    let over = |face: &Face| {
        let depth = face.offset - face.normal.dot(&arm);
        let out = face.normal * (depth + body.shape.sphero_radius());
        (depth, position + body.to_world(&out))
    };
    // One that was behind a wall before is at least not pushed farther.
    let has_room = |place: &Vec3| {
        let behind = |wall: &Plane| wall.height(place) < wall.height(position).min(0.0);
        !walls.iter().any(behind)
    };
    let places = body.shape.faces().iter().map(over);
    let nearest = places
        .filter(|(_, place)| has_room(place))
        .min_by(|one, other| one.0.total_cmp(&other.0));
    Some(match nearest {
        Some((_, place)) => PutBack::To(place),
        None => PutBack::NoRoom { depth: -distance },
    })
}

/// A box of world axes round a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Around {
    low: Vec3,
    high: Vec3,
}

impl Around {
    /// The box of a body, `reach` wider on every side.
    pub fn body(body: &Body, reach: f64) -> Self {
        let extent = |direction: Vec3| body.shape.extent_along(&body.to_body(&direction));
        let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
        let up = Vec3::from(axes.map(extent));
        let down = Vec3::from(axes.map(|axis| extent(-axis)));
        let reach = Vec3::repeat(reach);
        Self {
            low: body.state.position - down - reach,
            high: body.state.position + up + reach,
        }
    }

    /// The box round an upright column of this radius [m], without end.
    pub fn column(centre: Vec3, radius: f64) -> Self {
        let half = Vec3::new(radius, radius, f64::INFINITY);
        Self {
            low: centre - half,
            high: centre + half,
        }
    }

    /// As long, as high, and without end across.
    pub fn all_across(mut self) -> Self {
        (self.low.y, self.high.y) = (f64::NEG_INFINITY, f64::INFINITY);
        self
    }

    /// Its mirror image in the plane y = 0.
    pub fn mirrored(mut self) -> Self {
        (self.low.y, self.high.y) = (-self.high.y, -self.low.y);
        self
    }

    /// The same so much further across [m].
    pub fn shifted(mut self, across: f64) -> Self {
        self.low.y += across;
        self.high.y += across;
        self
    }

    /// Whether a place is in it.
    pub fn holds(&self, x: &Vec3) -> bool {
        (0..3).all(|axis| self.low[axis] <= x[axis] && x[axis] <= self.high[axis])
    }

    /// Whether it meets the box of a block of points.
    pub fn meets(&self, lattice: &Lattice, block: &BlockKey) -> bool {
        let first = lattice.position(block.map(|k| k * BLOCK as i32));
        let last = lattice.position(block.map(|k| (k + 1) * BLOCK as i32));
        (0..3).all(|axis| {
            // A point's lowest node is up to one and a half cells below it.
            let h = lattice.spacing[axis];
            self.low[axis] <= last[axis] + 0.5 * h && first[axis] + 0.5 * h <= self.high[axis]
        })
    }
}

#[cfg(test)]
mod tests;
