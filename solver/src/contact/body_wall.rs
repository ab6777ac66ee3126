//! Bodies on walls: sphere-swept vertices of a convex body against planes,
//! and the body's own sub-steps (docs/method.md, equations 15–20).

use crate::contact::law::TANGENTIAL_STIFFNESS_RATIO;
use crate::math::Vec3;
use crate::rigid::{Body, Freedom, Load};
use crate::walls::{Impulse, Plane};

/// Share of a contact's time scale √(m/k'), k' where it is deepest, taken per
/// body sub-step: an undamped impact lasts about four of them, so it gets forty.
const CONTACT_SHARE: f64 = 0.1;
/// Largest turn per body sub-step [rad].
const LARGEST_TURN: f64 = 0.05;
/// More body sub-steps than this never pay.
const MOST_SUBSTEPS: f64 = 10_000.0;

/// What one flow sub-step did to a body.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BodyReport {
    /// Impulse of the walls, about the origin.
    pub wall: Impulse,
    /// Impulse of gravity, about the origin.
    pub gravity: Impulse,
    /// Mean force and torque of the walls.
    pub wall_load: Load,
    /// Body sub-steps.
    pub substeps: u32,
    /// Body sub-steps that ended in touch with a wall.
    pub substeps_on_wall: u32,
}

/// Advances a body by `dt` under a constant load of the flow (force, and torque
/// about the centre at the start), gravity and the walls.
///
/// Velocity Verlet in as many sub-steps as the wall contacts ask for. The
/// flow's force keeps its line of action, so that points and body exchange
/// equal and opposite angular momentum.
pub fn advance(
    body: &mut Body,
    planes: &[Plane],
    flow: &Load,
    gravity: &Vec3,
    dt: f64,
) -> BodyReport {
    let mut report = BodyReport::default();
    if body.freedom == Freedom::Fixed {
        return report;
    }
    let count = substeps(body, planes, dt);
    let h = dt / count;
    let start = body.state.position;
    let weight = gravity * body.mass;
    for _ in 0..count as u32 {
        half_kick(body, &start, flow, &weight, 0.5 * h, &mut report);
        body.drift(h);
        touch_walls(body, planes, h);
        half_kick(body, &start, flow, &weight, 0.5 * h, &mut report);
        report.substeps += 1;
        report.substeps_on_wall += u32::from(body.state.wall_energy > 0.0);
    }
    report.wall_load.force /= dt;
    report.wall_load.torque /= dt;
    report
}

fn half_kick(
    body: &mut Body,
    start: &Vec3,
    flow: &Load,
    weight: &Vec3,
    dt: f64,
    report: &mut BodyReport,
) {
    let position = body.state.position;
    let wall = body.state.wall_load;
    let shifted = flow.torque - (position - start).cross(&flow.force);
    let total = Load {
        force: wall.force + flow.force + weight,
        torque: wall.torque + shifted,
    };
    body.kick(&total, dt);
    report.wall.add_at(&position, &(wall.force * dt));
    report.wall.angular += wall.torque * dt;
    report.gravity.add_at(&position, &(weight * dt));
    report.wall_load.force += wall.force * dt;
    report.wall_load.torque += wall.torque * dt;
}

/// Number of body sub-steps in `dt`, whole but kept as a float.
fn substeps(body: &Body, planes: &[Plane], dt: f64) -> f64 {
    let turns = body.angular_velocity().norm() * dt / LARGEST_TURN;
    let speed = body.largest_speed();
    let mut deepest = f64::NEG_INFINITY;
    for (_, _, overlap) in overlaps(body, planes) {
        deepest = deepest.max(overlap);
    }
    // What the body can travel in dt, with room for what accelerates it.
    let reach = 2.0 * speed * dt + 0.01 * body.shape.sphero_radius();
    let contacts = if deepest + reach > 0.0 {
        let law = &body.wall_law;
        let impact = (1.25 * body.mass * speed * speed / law.stiffness).powf(0.4);
        let lightest = lightest_effective_mass(body);
        dt / (CONTACT_SHARE * law.time_scale(deepest.max(impact), lightest))
    } else {
        0.0
    };
    turns.max(contacts).ceil().clamp(1.0, MOST_SUBSTEPS)
}

/// A lower bound of the effective mass at any place of the body [kg].
fn lightest_effective_mass(body: &Body) -> f64 {
    let radius = body.shape.bounding_radius();
    let turning = body.inverse_inertia.norm() * radius * radius;
    1.0 / (1.0 / body.mass + turning)
}

/// Every pair of core vertex and wall: (place of its spring, arm of the
/// vertex, overlap).
fn overlaps<'a>(
    body: &'a Body,
    planes: &'a [Plane],
) -> impl Iterator<Item = (usize, Vec3, f64)> + 'a {
    let radius = body.shape.sphero_radius();
    body.shape
        .core_vertices()
        .iter()
        .enumerate()
        .flat_map(move |(vertex, core)| {
            let arm = body.to_world(core);
            let place = body.state.position + arm;
            planes.iter().enumerate().map(move |(which, plane)| {
                let overlap = radius - plane.height(&place);
                (vertex * planes.len() + which, arm, overlap)
            })
        })
}

/// Renews the body's wall load and its springs after a drift of `dt`.
pub fn touch_walls(body: &mut Body, planes: &[Plane], dt: f64) {
    let mut load = Load::default();
    let mut energy = 0.0;
    let mut springs = std::mem::take(&mut body.state.springs);
    springs.resize(
        body.shape.core_vertices().len() * planes.len(),
        Vec3::zeros(),
    );
    for (place, arm, overlap) in overlaps(body, planes) {
        if overlap <= 0.0 {
            springs[place] = Vec3::zeros();
            continue;
        }
        let plane = &planes[place % planes.len()];
        let contact = Touch {
            arm: arm - plane.normal * (body.shape.sphero_radius() - 0.5 * overlap),
            normal: plane.normal,
            overlap,
        };
        let (force, held) = wall_force(body, &contact, dt, &mut springs[place]);
        load.add_at(&contact.arm, &force);
        energy += held;
    }
    body.state.springs = springs;
    body.state.wall_load = load;
    body.state.wall_energy = energy;
}

/// One vertex on one wall.
struct Touch {
    arm: Vec3,
    normal: Vec3,
    overlap: f64,
}

/// Force on the body [N] and the energy the contact holds [J].
fn wall_force(body: &Body, touch: &Touch, dt: f64, spring: &mut Vec3) -> (Vec3, f64) {
    let law = &body.wall_law;
    let mass = body.effective_mass(&touch.arm, &touch.normal);
    let velocity = body.velocity_at(&touch.arm);
    let along = velocity.dot(&touch.normal);
    let normal_force = law.normal_force(touch.overlap, -along, mass);
    let sliding = velocity - touch.normal * along;
    *spring += sliding * dt;
    let tangential = law.tangential_force(spring, &sliding, (touch.overlap, normal_force, mass));
    let elastic = law.elastic_energy(touch.overlap);
    let stretched = 0.5
        * TANGENTIAL_STIFFNESS_RATIO
        * law.tangent_stiffness(touch.overlap)
        * spring.norm_squared();
    (
        touch.normal * normal_force + tangential,
        elastic + stretched,
    )
}

#[cfg(test)]
mod tests;
