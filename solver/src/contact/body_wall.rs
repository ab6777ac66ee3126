//! Bodies on walls: sphere-swept vertices of a convex body against planes
//! (docs/method.md, equations 17–19).

use crate::contact::law::mass_seen;
use crate::math::Vec3;
use crate::rigid::{Body, Load};
use crate::walls::Plane;

/// Deepest overlap of the body with a wall [m]; negative when apart.
pub fn deepest_overlap(body: &Body, planes: &[Plane]) -> f64 {
    overlaps(body, planes).fold(f64::NEG_INFINITY, |deepest, (_, _, overlap)| {
        deepest.max(overlap)
    })
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
    let count = body.shape.core_vertices().len() * planes.len();
    let mut springs = std::mem::take(&mut body.state.springs);
    let mut rolling = std::mem::take(&mut body.state.rolling);
    springs.resize(count, Vec3::zeros());
    if body.rolling_friction > 0.0 {
        rolling.resize(count, Vec3::zeros());
    }
    if body.state.wall_overlap == 0.0 && clear_of(body, planes) {
        body.state.springs = springs;
        body.state.rolling = rolling;
        body.state.wall_load = Load::default();
        body.state.wall_energy = 0.0;
        return;
    }
    let push = elastic_push(body, planes);
    let mut load = Load::default();
    let mut energy = 0.0;
    let mut deepest: f64 = 0.0;
    for (place, arm, overlap) in overlaps(body, planes) {
        deepest = deepest.max(overlap);
        if overlap <= 0.0 {
            springs[place] = Vec3::zeros();
            if let Some(stretch) = rolling.get_mut(place) {
                *stretch = Vec3::zeros();
            }
            continue;
        }
        let touch = Touch::of(body, &planes[place % planes.len()], &arm, overlap);
        let mass = mass_on(body, &push, &touch);
        let (force, held) = wall_force(body, &touch, mass, dt, &mut springs[place]);
        load.add_at(&touch.arm, &force);
        energy += held;
        if let Some(stretch) = rolling.get_mut(place) {
            let pressed = force.dot(&touch.normal);
            let (couple, held) = wall_couple(body, &touch, (pressed, mass), dt, stretch);
            load.torque += couple;
            energy += held;
        }
    }
    body.state.springs = springs;
    body.state.rolling = rolling;
    body.state.wall_load = load;
    body.state.wall_energy = energy;
    body.state.wall_overlap = deepest;
}

/// Whether no wall comes as near as the bounding ball.
fn clear_of(body: &Body, planes: &[Plane]) -> bool {
    let radius = body.shape.bounding_radius();
    let heights = planes.iter();
    heights
        .map(|plane| plane.height(&body.state.position))
        .all(|height| height > radius)
}

/// The elastic forces of all walls together.
fn elastic_push(body: &Body, planes: &[Plane]) -> Load {
    let mut push = Load::default();
    for (place, arm, overlap) in overlaps(body, planes) {
        if overlap > 0.0 {
            let touch = Touch::of(body, &planes[place % planes.len()], &arm, overlap);
            let force = touch.normal * body.wall_law.elastic_force(overlap);
            push.add_at(&touch.arm, &force);
        }
    }
    push
}

/// Couple against rolling on a wall, and the energy its spring holds.
fn wall_couple(
    body: &Body,
    touch: &Touch,
    (pressed, mass): (f64, f64),
    dt: f64,
    stretch: &mut Vec3,
) -> (Vec3, f64) {
    let spin = body.angular_velocity();
    let rolling = spin - touch.normal * spin.dot(&touch.normal);
    let resistance = (body.rolling_friction, body.shape.sphero_radius());
    let state = (touch.overlap, pressed, mass);
    body.wall_law
        .rolling_couple(resistance, stretch, &rolling, dt, state)
}

/// One vertex on one wall.
struct Touch {
    arm: Vec3,
    normal: Vec3,
    overlap: f64,
}

impl Touch {
    /// In the middle of the overlap.
    fn of(body: &Body, plane: &Plane, vertex: &Vec3, overlap: f64) -> Self {
        Self {
            arm: vertex - plane.normal * (body.shape.sphero_radius() - 0.5 * overlap),
            normal: plane.normal,
            overlap,
        }
    }
}

/// Mass that a contact has to stop, of what all walls stop together (equation 46) [kg].
fn mass_on(body: &Body, push: &Load, touch: &Touch) -> f64 {
    let force = body.wall_law.elastic_force(touch.overlap);
    let acceleration = body.acceleration_at(push, &touch.arm).dot(&touch.normal);
    mass_seen(force, acceleration, body.mass)
}

/// Force on the body [N] and the energy the contact holds [J].
fn wall_force(body: &Body, touch: &Touch, mass: f64, dt: f64, spring: &mut Vec3) -> (Vec3, f64) {
    let law = &body.wall_law;
    let velocity = body.velocity_at(&touch.arm);
    let along = velocity.dot(&touch.normal);
    let normal_force = law.normal_force(touch.overlap, -along, mass);
    let sliding = velocity - touch.normal * along;
    *spring += sliding * dt;
    let tangential = law.tangential_force(spring, &sliding, (touch.overlap, normal_force, mass));
    let elastic = law.elastic_energy(touch.overlap);
    let stretched = law.stretched_energy(spring, touch.overlap);
    (
        touch.normal * normal_force + tangential,
        elastic + stretched,
    )
}

#[cfg(test)]
mod tests;
