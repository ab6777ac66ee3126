//! Material points on bodies: each point's sphere against the body's rounded
//! surface at the closest feature (docs/method.md, equations 21–24).

use crate::grid::{BLOCK, Grid, PointBlock};
use crate::math::Vec3;
use crate::points::Point;
use crate::rigid::{Body, Freedom, Load};
use crate::walls::Impulse;

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
    /// Points that find room on a body's silhouette, at least one.
    pub fn most_touching(&self, body: &Body) -> f64 {
        let radius = body.shape.bounding_radius();
        (std::f64::consts::PI * (radius / self.spacing).powi(2)).max(1.0)
    }

    /// Largest damping coefficient of one point on this body [N s/m].
    fn braking(&self, body: &Body, dt: f64) -> f64 {
        match body.freedom {
            Freedom::Fixed => self.impedance,
            Freedom::Free => {
                let share = LARGEST_BRAKING * body.mass / (self.most_touching(body) * dt);
                self.impedance.min(share)
            }
        }
    }
}

/// A point that may touch a body within the step.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Candidate {
    point: usize,
    block: usize,
}

/// Contact forces of one sub-step.
#[derive(Debug, Default)]
pub struct Loads {
    /// Force on every point [N].
    pub on_points: Vec<Vec3>,
    /// What the flow does to every body.
    pub on_bodies: Vec<FlowLoad>,
    candidates: Vec<Vec<Candidate>>,
    pushed: Vec<usize>,
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

impl Loads {
    /// Prepares a step: finds the points within `reach` [m] of each body.
    pub fn find_candidates(&mut self, points: &[Point], grid: &Grid, bodies: &[Body], reach: f64) {
        self.on_points.clear();
        self.on_points.resize(points.len(), Vec3::zeros());
        self.pushed.clear();
        self.on_bodies.clear();
        self.on_bodies.resize(bodies.len(), FlowLoad::default());
        self.candidates.resize(bodies.len(), Vec::new());
        for (body, candidates) in bodies.iter().zip(&mut self.candidates) {
            candidates.clear();
            let around = Around::body(body, reach);
            for (place, block) in grid.point_blocks().iter().enumerate() {
                if !around.meets_block(grid, block) {
                    continue;
                }
                let inside = block
                    .points
                    .clone()
                    .filter(|point| around.holds(&points[*point].position));
                candidates.extend(inside.map(|point| Candidate {
                    point,
                    block: place,
                }));
            }
        }
    }

    /// Impulse the bodies of one freedom give the flow in `dt`.
    pub fn impulse_on_flow(&self, bodies: &[Body], dt: f64, freedom: Freedom) -> Impulse {
        let mut impulse = Impulse::default();
        for (body, flow) in bodies.iter().zip(&self.on_bodies) {
            if body.freedom == freedom {
                impulse.add_at(&body.state.position, &(flow.load.force * -dt));
                impulse.angular -= flow.load.torque * dt;
            }
        }
        impulse
    }

    /// Contact forces at the points' present positions and velocities.
    pub fn evaluate(
        &mut self,
        points: &[Point],
        grid: &Grid,
        bodies: &[Body],
        sphere: PointSphere,
        dt: f64,
    ) {
        for point in self.pushed.drain(..) {
            self.on_points[point] = Vec3::zeros();
        }
        for ((body, candidates), on_body) in
            bodies.iter().zip(&self.candidates).zip(&mut self.on_bodies)
        {
            *on_body = FlowLoad::default();
            let braking = sphere.braking(body, dt);
            for candidate in candidates {
                let point = &points[candidate.point];
                let stencil = grid.lattice().stencil(&point.position);
                let block = &grid.point_blocks()[candidate.block];
                let (velocity, displacement) = grid.motion_at(block, &stencil);
                let meeting = Meeting {
                    arm: point.position + displacement - body.state.position,
                    velocity,
                    mass: point.mass,
                    radius: sphere.radius,
                    braking,
                };
                if let Some(force) = meeting.force(body, on_body) {
                    self.on_points[candidate.point] += force;
                    self.pushed.push(candidate.point);
                }
            }
        }
    }
}

/// A point's sphere near a body.
struct Meeting {
    arm: Vec3,
    velocity: Vec3,
    mass: f64,
    radius: f64,
    /// Largest damping coefficient [N s/m].
    braking: f64,
}

impl Meeting {
    /// Force on the point [N], its reverse added to the body; `None` if apart.
    fn force(&self, body: &Body, on_body: &mut FlowLoad) -> Option<Vec3> {
        let closest = body.shape.closest_feature(&body.to_body(&self.arm));
        let reach = self.radius + body.shape.sphero_radius();
        let overlap = reach - closest.distance;
        if overlap <= 0.0 {
            return None;
        }
        let normal = body.to_world(&closest.normal);
        let relative = self.velocity - body.velocity_at(&self.arm);
        let along = relative.dot(&normal);
        let law = &body.flow_law;
        let damping = law
            .damping_coefficient(overlap, self.mass)
            .min(self.braking);
        let pressed = (law.elastic_force(overlap) - damping * along).max(0.0);
        let sliding = relative - normal * along;
        let slip = sliding.norm().max(f64::MIN_POSITIVE);
        let friction = self.braking.min(law.friction * pressed / slip);
        let force = normal * pressed - sliding * friction;

        on_body.load.add_at(&self.arm, &-force);
        on_body.touching_points += 1;
        on_body.deepest_overlap_ratio = on_body.deepest_overlap_ratio.max(overlap / reach);
        on_body.energy += law.elastic_energy(overlap);
        Some(force)
    }
}

/// Puts points that ended a step inside a body's core back on its surface;
/// returns how many.
pub fn put_back(points: &mut [Point], grid: &Grid, bodies: &[Body]) -> u64 {
    let mut count = 0;
    for body in bodies {
        let around = Around::body(body, 0.0);
        for block in grid.point_blocks() {
            // Points may have left the block's box by a fraction of a cell
            // since the transfer; meets_block allows for it.
            if !around.meets_block(grid, block) {
                continue;
            }
            for point in &mut points[block.points.clone()] {
                if around.holds(&point.position) {
                    count += u64::from(pushed_out(point, body));
                }
            }
        }
    }
    count
}

fn pushed_out(point: &mut Point, body: &Body) -> bool {
    let arm = body.to_body(&(point.position - body.state.position));
    let closest = body.shape.closest_feature(&arm);
    let inside = closest.distance < 0.0;
    if inside {
        let out = closest.normal * (body.shape.sphero_radius() - closest.distance);
        point.position += body.to_world(&out);
    }
    inside
}

/// A box of world axes round a body.
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

    /// Whether a place is in it.
    pub fn holds(&self, x: &Vec3) -> bool {
        (0..3).all(|axis| self.low[axis] <= x[axis] && x[axis] <= self.high[axis])
    }

    /// Whether it meets the box of a block of points, widened by a cell for
    /// what the points moved since they were sorted.
    fn meets_block(&self, grid: &Grid, block: &PointBlock) -> bool {
        let lattice = grid.lattice();
        let first = lattice.position(block.key.map(|k| k * BLOCK as i32));
        let last = lattice.position(block.key.map(|k| (k + 1) * BLOCK as i32));
        (0..3).all(|axis| {
            let h = lattice.spacing[axis];
            self.low[axis] <= last[axis] + 1.5 * h && first[axis] - 0.5 * h <= self.high[axis]
        })
    }
}

#[cfg(test)]
mod tests;
