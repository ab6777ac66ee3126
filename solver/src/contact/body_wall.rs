//! Bodies on walls: sphere-swept vertices of a convex body against planes
//! (docs/method.md, equations 17–19).

use crate::contact::dissipation::{Damping, stopping};
use crate::contact::friction::{Spring, viscous_part};
use crate::contact::law::mass_seen;
use crate::math::Vec3;
use crate::rigid::{Body, BodyState, Load};
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
    body.state.springs.resize(count, Spring::NEW);
    if body.rolling_friction > 0.0 {
        body.state.rolling.resize(count, Spring::NEW);
    }
    let apart = body.state.wall_overlap == 0.0;
    body.state.wall_load = Load::default();
    body.state.wall_energy = 0.0;
    if apart && clear_of(body, planes) {
        return;
    }
    let touches = touches(body, planes);
    body.state.wall_overlap = deepest_of(&touches);
    forget_what_is_apart(&mut body.state, &touches);
    if touches.is_empty() {
        return;
    }
    let push = elastic_push(body, &touches);
    let pressed = press(body, &touches, &push, dt);
    let (mut springs, mut rolling) = (
        std::mem::take(&mut body.state.springs),
        std::mem::take(&mut body.state.rolling),
    );
    let rubbed = rub(body, &pressed, [&mut springs, &mut rolling], dt);
    let elastic = pressed
        .iter()
        .map(|pressed| body.wall_law.elastic_energy(pressed.touch.overlap));
    body.state.wall_energy = elastic.sum::<f64>() + rubbed.energy;
    for pressed in &pressed {
        let Touch { arm, normal, .. } = &pressed.touch;
        body.state.wall_load.add_at(arm, &(normal * pressed.force));
    }
    body.state.wall_load.add(&rubbed.load);
    (body.state.springs, body.state.rolling) = (springs, rolling);
}

/// Every vertex that overlaps a wall.
fn touches(body: &Body, planes: &[Plane]) -> Vec<Touch> {
    overlaps(body, planes)
        .filter(|(_, _, overlap)| *overlap > 0.0)
        .map(|(place, arm, overlap)| {
            Touch::of(body, (place, &planes[place % planes.len()]), &arm, overlap)
        })
        .collect()
}

fn deepest_of(touches: &[Touch]) -> f64 {
    let overlaps = touches.iter().map(|touch| touch.overlap);
    overlaps.fold(0.0, f64::max)
}

fn forget_what_is_apart(state: &mut BodyState, touches: &[Touch]) {
    for springs in [&mut state.springs, &mut state.rolling] {
        let mut touching = touches.iter().map(|touch| touch.place).peekable();
        for (place, spring) in springs.iter_mut().enumerate() {
            if touching.next_if_eq(&place).is_none() {
                *spring = Spring::NEW;
            }
        }
    }
}

/// The elastic forces of all walls together.
fn elastic_push(body: &Body, touches: &[Touch]) -> Load {
    let mut push = Load::default();
    for touch in touches {
        let force = touch.normal * body.wall_law.elastic_force(touch.overlap);
        push.add_at(&touch.arm, &force);
    }
    push
}

/// A vertex that a wall presses.
struct Pressed<'a> {
    touch: &'a Touch,
    /// Mass that the contact has to stop (equation 46) [kg].
    mass: f64,
    /// Normal force [N].
    force: f64,
}

/// Normal forces, with the share of damping that takes energy (equation 18b).
fn press<'a>(body: &Body, touches: &'a [Touch], push: &Load, dt: f64) -> Vec<Pressed<'a>> {
    let law = &body.wall_law;
    let (mut damping, mut sum) = (Damping::default(), Load::default());
    let mut pressed: Vec<Pressed> = touches
        .iter()
        .map(|touch| {
            let elastic = law.elastic_force(touch.overlap);
            let acceleration = body.acceleration_at(push, &touch.arm).dot(&touch.normal);
            let mass = mass_seen(elastic, acceleration, body.mass);
            let approach = -body.velocity_at(&touch.arm).dot(&touch.normal);
            let force = law.normal_force(touch.overlap, approach, mass);
            damping.power -= (force - elastic) * approach;
            sum.add_at(&touch.arm, &(touch.normal * (force - elastic)));
            Pressed { touch, mass, force }
        })
        .collect();
    damping.stopping = stopping(body, &sum);
    let share = damping.share(dt);
    for pressed in &mut pressed {
        let elastic = law.elastic_force(pressed.touch.overlap);
        pressed.force = elastic + share * (pressed.force - elastic);
    }
    pressed
}

/// What friction and rolling resistance do.
struct Rubbed {
    load: Load,
    /// What their springs hold [J].
    energy: f64,
}

/// Friction and rolling resistance, with the share of damping that takes energy.
fn rub(
    body: &Body,
    pressed: &[Pressed],
    [springs, rolling]: [&mut [Spring]; 2],
    dt: f64,
) -> Rubbed {
    let law = &body.wall_law;
    let spin = body.angular_velocity();
    let radius = body.shape.sphero_radius();
    let mut rubbed = Rubbed {
        load: Load::default(),
        energy: 0.0,
    };
    let (mut damping, mut sum) = (Damping::default(), Load::default());
    for Pressed { touch, mass, force } in pressed {
        let stiffness = law.tangential_stiffness(touch.overlap);
        let viscous = law.tangential_damping(touch.overlap, *mass);
        let across = |v: &Vec3| v - touch.normal * v.dot(&touch.normal);
        let mut resist = |spring: &mut Spring, velocity: Vec3, cap: f64| {
            spring.stiffen(stiffness);
            let elastic = spring.slide(&(velocity * dt), cap);
            let part = viscous_part(&elastic, viscous, &velocity, cap);
            rubbed.energy += spring.energy();
            damping.power += part.dot(&velocity);
            [elastic, part]
        };
        let sliding = across(&body.velocity_at(&touch.arm));
        let [elastic, part] = resist(&mut springs[touch.place], sliding, law.friction * force);
        rubbed.load.add_at(&touch.arm, &elastic);
        sum.add_at(&touch.arm, &part);
        if let Some(spring) = rolling.get_mut(touch.place) {
            let turning = across(&spin) * radius;
            let [elastic, part] = resist(spring, turning, body.rolling_friction * force);
            rubbed.load.torque += elastic * radius;
            sum.torque += part * radius;
        }
    }
    damping.stopping = stopping(body, &sum);
    let share = damping.share(dt);
    rubbed.load.add(&Load {
        force: sum.force * share,
        torque: sum.torque * share,
    });
    rubbed
}

/// Whether no wall comes as near as the bounding ball.
fn clear_of(body: &Body, planes: &[Plane]) -> bool {
    let radius = body.shape.bounding_radius();
    let heights = planes.iter();
    heights
        .map(|plane| plane.height(&body.state.position))
        .all(|height| height > radius)
}

/// One vertex on one wall.
struct Touch {
    /// Where its springs are.
    place: usize,
    /// Middle of the overlap, from the centre of mass [m].
    arm: Vec3,
    normal: Vec3,
    overlap: f64,
}

impl Touch {
    fn of(body: &Body, (place, plane): (usize, &Plane), vertex: &Vec3, overlap: f64) -> Self {
        Self {
            place,
            arm: vertex - plane.normal * (body.shape.sphero_radius() - 0.5 * overlap),
            normal: plane.normal,
            overlap,
        }
    }
}

#[cfg(test)]
mod tests;
