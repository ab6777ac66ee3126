//! Balances of mass, momentum and energy, kept while a run goes
//! (docs/method.md, equations 35–38).

use crate::material::Material;
use crate::math::Vec3;
use crate::points::Point;
use crate::rigid::Body;
use crate::walls::{Impulse, in_plane};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Points summed by one task; fixed, so that sums do not depend on threads.
const CHUNK: usize = 1024;

/// Sums over points or bodies.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Totals {
    /// Mass [kg].
    pub mass: f64,
    /// Σ m x [kg m].
    pub first_moment: Vec3,
    /// Momentum, linear and angular about the origin.
    pub momentum: Impulse,
    /// Σ m|v| [kg m/s].
    pub momentum_scale: f64,
    /// Kinetic energy [J].
    pub kinetic_energy: f64,
    /// Kinetic, potential and elastic energy [J].
    pub energy: f64,
}

impl Totals {
    /// The sum of both.
    pub fn plus(mut self, other: &Self) -> Self {
        self.mass += other.mass;
        self.first_moment += other.first_moment;
        self.momentum.linear += other.momentum.linear;
        self.momentum.angular += other.momentum.angular;
        self.momentum_scale += other.momentum_scale;
        self.kinetic_energy += other.kinetic_energy;
        self.energy += other.energy;
        self
    }

    /// The sums less those of others.
    pub fn less(mut self, other: &Self) -> Self {
        self.mass -= other.mass;
        self.first_moment -= other.first_moment;
        self.momentum.linear -= other.momentum.linear;
        self.momentum.angular -= other.momentum.angular;
        self.momentum_scale -= other.momentum_scale;
        self.kinetic_energy -= other.kinetic_energy;
        self.energy -= other.energy;
        self
    }

    /// Sums over so many images, which lie symmetrically about the plane y = 0. One image leaves
    /// the sums unchanged.
    pub fn of_images(&self, count: f64) -> Self {
        if count == 1.0 {
            return *self;
        }
        Self {
            mass: self.mass * count,
            first_moment: in_plane(&self.first_moment) * count,
            momentum: self.momentum.of_images(count),
            momentum_scale: self.momentum_scale * count,
            kinetic_energy: self.kinetic_energy * count,
            energy: self.energy * count,
        }
    }

    /// Sums over the points of a flow.
    pub fn of_points(
        points: &[Point],
        material: &Material,
        kernel_moment: &Vec3,
        gravity: &Vec3,
    ) -> Self {
        let of_chunk = |chunk: &[Point]| {
            chunk
                .iter()
                .map(|point| Self::of_point(point, material, kernel_moment, gravity))
                .fold(Self::default(), |sum, one| sum.plus(&one))
        };
        let chunks: Vec<Self> = points.par_chunks(CHUNK).map(of_chunk).collect();
        chunks.iter().fold(Self::default(), Self::plus)
    }

    fn of_point(point: &Point, material: &Material, moment: &Vec3, gravity: &Vec3) -> Self {
        let kinetic_energy = point.kinetic_energy(moment);
        let potential = -point.mass * gravity.dot(&point.position);
        let speed = point.velocity.norm();
        Self {
            mass: point.mass,
            first_moment: point.position * point.mass,
            momentum: Impulse {
                linear: point.velocity * point.mass,
                angular: point.angular_momentum(moment),
            },
            momentum_scale: point.mass * speed,
            kinetic_energy,
            energy: kinetic_energy + potential + point.elastic_energy(material),
        }
    }

    /// Sums over the free bodies.
    pub fn of_bodies(bodies: &[Body], gravity: &Vec3) -> Self {
        bodies
            .iter()
            .filter(|body| body.is_free())
            .map(|body| Self::of_body(body, gravity))
            .fold(Self::default(), |sum, one| sum.plus(&one))
    }

    fn of_body(body: &Body, gravity: &Vec3) -> Self {
        let state = &body.state;
        let kinetic_energy = body.kinetic_energy();
        let potential = -body.mass * gravity.dot(&state.position);
        Self {
            mass: body.mass,
            first_moment: state.position * body.mass,
            momentum: Impulse {
                linear: state.momentum,
                angular: state.position.cross(&state.momentum) + state.angular_momentum,
            },
            momentum_scale: state.momentum.norm(),
            kinetic_energy,
            energy: kinetic_energy + potential + state.wall_energy,
        }
    }
}

/// Moments of the flow, updated with its motion from one audit to the next.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct FlowMoments {
    mass: f64,
    /// Σ m x [kg m].
    pub first_moment: Vec3,
    /// Momentum [kg m/s].
    pub momentum: Vec3,
}

impl FlowMoments {
    /// Moments at an audit.
    pub fn of(flow: &Totals) -> Self {
        Self {
            mass: flow.mass,
            first_moment: flow.first_moment,
            momentum: flow.momentum.linear,
        }
    }

    /// Adds the points of a later release.
    pub fn gain(&mut self, come: &Totals) {
        self.mass += come.mass;
        self.first_moment += come.first_moment;
        self.momentum += come.momentum.linear;
    }

    /// Subtracts the points that left.
    pub fn lose(&mut self, gone: &Totals) {
        self.mass -= gone.mass;
        self.first_moment -= gone.first_moment;
        self.momentum -= gone.momentum.linear;
    }

    /// Impulse of gravity in `dt`.
    pub fn weight(&self, gravity: &Vec3, dt: f64) -> Impulse {
        Impulse {
            linear: gravity * (self.mass * dt),
            angular: self.first_moment.cross(gravity) * dt,
        }
    }
}

/// The conservation audit of a run: expected sums against the actual ones.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Audit {
    /// Mass released so far [kg].
    pub released_mass: f64,
    /// Expected momentum: the initial one, plus every impulse from outside, less the momentum of
    /// outflow.
    expected: Impulse,
    /// Accumulated magnitudes of those impulses, linear and angular.
    exchanged: (f64, f64),
    /// Energy of the points released after the start [J].
    entered: f64,
    /// Totals of the outflow through the open end.
    left: Totals,
    /// Points that left through the open end.
    pub points_outflow: u64,
    /// Penetration corrections out of a body's core.
    pub penetration_corrections: u64,
    /// Number of comparisons.
    pub checks: u64,
    /// Largest mass residual so far, relative.
    pub mass_error: f64,
    /// Largest residual of linear momentum, relative.
    pub momentum_residual: f64,
    /// Largest residual of angular momentum, relative.
    pub angular_momentum_residual: f64,
    /// Largest overlap δ/(R_p + r).
    pub deepest_overlap_ratio: f64,
    /// Largest overlap of a body with a wall or another body, δ/r.
    pub deepest_body_overlap_ratio: f64,
    spread: Vec3,
    /// Angular momentum from particle shifting, relative as the residual.
    pub angular_momentum_from_shifting: f64,
    start_energy: f64,
    lowest_energy: f64,
    largest_rise: f64,
    largest_kinetic_energy: f64,
    /// Work that prescribed motions have done.
    given: f64,
    /// Accumulated magnitudes of it.
    given_size: f64,
}

impl Audit {
    /// The audit of a run that starts with these sums.
    pub fn start(flow: &Totals, bodies: &Totals) -> Self {
        let total = flow.plus(bodies);
        Self {
            released_mass: flow.mass,
            expected: total.momentum,
            start_energy: total.energy,
            lowest_energy: total.energy,
            ..Self::default()
        }
    }

    /// Adds an impulse from outside.
    pub fn exchange(&mut self, impulse: &Impulse) {
        self.expected.linear += impulse.linear;
        self.expected.angular += impulse.angular;
        self.exchanged.0 += impulse.linear.norm();
        self.exchanged.1 += impulse.angular.norm();
    }

    /// Adds work of a prescribed motion [J].
    pub fn give(&mut self, work: f64) {
        self.given += work;
        self.given_size += work.abs();
    }

    /// Work that prescribed motions have done [J].
    pub fn work_given(&self) -> f64 {
        self.given
    }

    /// Adds the angular momentum from particle shifting [N m s].
    pub fn spread(&mut self, angular: &Vec3) {
        self.expected.angular += angular;
        self.spread += angular;
    }

    /// Adds an overlap of a point and a body, δ/(R_p + r).
    pub fn meet(&mut self, overlap_ratio: f64) {
        self.deepest_overlap_ratio = self.deepest_overlap_ratio.max(overlap_ratio);
    }

    /// Adds an overlap of a body and a wall or another body, δ/r.
    pub fn meet_solid(&mut self, overlap_ratio: f64) {
        self.deepest_body_overlap_ratio = self.deepest_body_overlap_ratio.max(overlap_ratio);
    }

    /// Adds points that are released after the start.
    pub fn enter(&mut self, come: &Totals) {
        self.released_mass += come.mass;
        self.entered += come.energy;
        self.expected.linear += come.momentum.linear;
        self.expected.angular += come.momentum.angular;
    }

    /// Adds points that left through the open end.
    pub fn leave(&mut self, count: u64, gone: &Totals) {
        self.points_outflow += count;
        self.left = self.left.plus(gone);
        self.expected.linear -= gone.momentum.linear;
        self.expected.angular -= gone.momentum.angular;
    }

    /// Mass that left through the open end [kg].
    pub fn outflow_mass(&self) -> f64 {
        self.left.mass
    }

    /// Compares the actual sums with the expected ones, after a step; `contact_energy` is stored
    /// between points and bodies [J].
    pub fn check(&mut self, flow: &Totals, bodies: &Totals, contact_energy: f64) {
        self.checks += 1;
        let total = flow.plus(bodies);
        let off = |actual: &Vec3, expected: &Vec3, scale: f64| {
            (actual - expected).norm() / scale.max(f64::MIN_POSITIVE)
        };
        let linear = off(
            &total.momentum.linear,
            &self.expected.linear,
            total.momentum_scale + self.exchanged.0,
        );
        let scale = total.momentum.angular.norm() + self.exchanged.1;
        let angular = off(&total.momentum.angular, &self.expected.angular, scale);
        let spread = off(&self.spread, &Vec3::zeros(), scale);
        self.angular_momentum_from_shifting = self.angular_momentum_from_shifting.max(spread);
        self.momentum_residual = self.momentum_residual.max(linear);
        self.angular_momentum_residual = self.angular_momentum_residual.max(angular);
        if self.released_mass > 0.0 {
            let missing = (flow.mass + self.left.mass - self.released_mass).abs();
            self.mass_error = self.mass_error.max(missing / self.released_mass);
        }
        let released = self.entered + self.given;
        let energy = total.energy + self.left.energy + contact_energy - released;
        self.lowest_energy = self.lowest_energy.min(energy);
        self.largest_rise = self.largest_rise.max(energy - self.lowest_energy);
        self.largest_kinetic_energy = self.largest_kinetic_energy.max(total.kinetic_energy);
    }

    /// Largest rise of the mechanical energy, less the work of prescribed motions, above
    /// its running minimum [J].
    pub fn energy_rise(&self) -> f64 {
        self.largest_rise
    }

    /// Energy that a rise is compared with where little moves: the magnitude of the initial energy,
    /// heights counted from the floor, the largest kinetic energy, and the accumulated work of
    /// prescribed motions [J].
    pub fn energy_scale(&self) -> f64 {
        let released = self.start_energy.abs() + self.entered.abs();
        released + self.largest_kinetic_energy + self.given_size
    }

    /// Largest rise of the mechanical energy, less the work of prescribed motions, above
    /// its running minimum, relative to the largest kinetic energy so far; 0 if nothing ever moved.
    pub fn energy_residual(&self) -> f64 {
        if self.largest_kinetic_energy > 0.0 {
            self.largest_rise / self.largest_kinetic_energy
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests;
