//! Bodies on walls: sphere-swept vertices of a convex body against planes, and a body on a terrain
//! (docs/method.md, equations 17–19).

use crate::contact::dissipation::{Damping, Taken, stopping};
use crate::contact::friction::Spring;
use crate::contact::law::effective_contact_mass;
use crate::contact::wall_touch::WallTouch;
use crate::math::Vec3;
use crate::rigid::{Body, BodyState, Load};
use crate::walls::{Plane, RigidWalls};

mod ground;

pub use ground::ground_gap;
use ground::{deepest_on_ground, find_on_ground};

/// Height over the sphero radius up to which a vertex is looked at: more than 1, since it is
/// turned in another way and thus rounded differently.
const NEAR: f64 = 1.001;

/// Deepest overlap of the body with a wall [m]; negative when apart, where a terrain farther than
/// `within` [m] does not count.
pub fn deepest_overlap(body: &Body, walls: &RigidWalls, within: f64) -> f64 {
    let on_planes = deepest_on_planes(body, walls.planes);
    match walls.terrain {
        Some(ground) => on_planes.max(deepest_on_ground(body, ground, within)),
        None => on_planes,
    }
}

fn deepest_on_planes(body: &Body, planes: &[Plane]) -> f64 {
    let radius = body.shape.sphero_radius();
    let vertices = body.shape.core_vertices().iter();
    let places = vertices.map(|core| body.state.position + body.to_world(core));
    let overlaps = places.flat_map(|place| {
        let overlap = move |plane: &Plane| radius - plane.height(&place);
        planes.iter().map(overlap)
    });
    overlaps.fold(f64::NEG_INFINITY, f64::max)
}

/// Updates the body's wall load and its springs after a drift of `dt`; returns the dissipation
/// of the contacts.
pub fn evaluate_wall_contacts(body: &mut Body, walls: &RigidWalls, dt: f64) -> Taken {
    let mut taken = Taken::default();
    let count = count_of_springs(body, walls);
    body.state.springs.resize(count, Spring::NEW);
    if body.rolling_friction > 0.0 {
        body.state.rolling.resize(count, Spring::NEW);
    }
    let apart = body.state.wall_overlap == 0.0;
    body.state.wall_load = Load::default();
    body.state.wall_energy = 0.0;
    let mut touches = std::mem::take(&mut body.wall_touches);
    if let Some(ground) = walls.terrain {
        taken.lost += find_on_ground(body, ground, &mut touches);
    } else if apart && clear_of(body, walls.planes) {
        body.wall_touches = touches;
        return taken;
    } else {
        find_touches(body, walls.planes, &mut touches);
    }
    body.state.wall_overlap = deepest_of(&touches);
    taken.lost += forget_what_is_apart(&mut body.state, &touches);
    if !touches.is_empty() {
        press(body, &mut touches, &mut taken, dt);
        rub(body, &touches, &mut taken, dt);
    }
    body.wall_touches = touches;
    taken
}

/// Springs of a body: of every pair of vertex and plane, or of every vertex on a terrain and the
/// nodes that it touches there.
fn count_of_springs(body: &Body, walls: &RigidWalls) -> usize {
    let vertices = body.shape.core_vertices().len();
    match walls.terrain {
        Some(_) => vertices + body.state.ground_nodes.len(),
        None => vertices * walls.planes.len(),
    }
}

/// Puts every vertex that overlaps a plane into `touches`, in the order of their springs.
fn find_touches(body: &mut Body, planes: &[Plane], touches: &mut Vec<WallTouch>) {
    touches.clear();
    body.turn_core();
    let body = &*body;
    let radius = body.shape.sphero_radius();
    for (which, plane) in planes.iter().enumerate() {
        if !reaches(plane, body) {
            continue;
        }
        let vertices = body.turned_core().iter().enumerate();
        let near = |turned: &Vec3| plane.height(&(body.state.position + turned)) < NEAR * radius;
        for (vertex, _) in vertices.filter(|(_, turned)| near(turned)) {
            let arm = body.to_world(&body.shape.core_vertices()[vertex]);
            let overlap = radius - plane.height(&(body.state.position + arm));
            if overlap > 0.0 {
                touches.push(WallTouch {
                    place: vertex * planes.len() + which,
                    arm: arm - plane.normal * (radius - 0.5 * overlap),
                    normal: plane.normal,
                    overlap,
                    mass: body.mass,
                    force: 0.0,
                });
            }
        }
    }
    touches.sort_unstable_by_key(|touch| touch.place);
}

fn deepest_of(touches: &[WallTouch]) -> f64 {
    let overlaps = touches.iter().map(|touch| touch.overlap);
    overlaps.fold(0.0, f64::max)
}

/// Releases the springs of contacts that have parted; returns the energy they stored [J].
fn forget_what_is_apart(state: &mut BodyState, touches: &[WallTouch]) -> f64 {
    let mut lost = 0.0;
    for springs in [&mut state.springs, &mut state.rolling] {
        let mut touching = touches.iter().map(|touch| touch.place).peekable();
        for (place, spring) in springs.iter_mut().enumerate() {
            if touching.next_if_eq(&place).is_none() && *spring != Spring::NEW {
                lost += spring.energy();
                *spring = Spring::NEW;
            }
        }
    }
    lost
}

/// Normal forces, with the share of damping that takes energy (equation 18b); they are
/// the first part of the wall's load.
fn press(body: &mut Body, touches: &mut [WallTouch], taken: &mut Taken, dt: f64) {
    let law = body.wall_law;
    let mut push = Load::default();
    for touch in &*touches {
        let force = touch.normal * law.elastic_force(touch.overlap);
        push.add_at(&touch.arm, &force);
    }
    let (velocity, spin) = (body.velocity(), body.angular_velocity());
    let (parting, turning) = (
        push.force / body.mass,
        body.angular_acceleration(&push.torque),
    );
    let (mut damping, mut sum) = (Damping::default(), Load::default());
    for touch in &mut *touches {
        let elastic = law.elastic_force(touch.overlap);
        let acceleration = (parting + turning.cross(&touch.arm)).dot(&touch.normal);
        touch.mass = effective_contact_mass(elastic, acceleration, body.mass);
        let approach = -(velocity + spin.cross(&touch.arm)).dot(&touch.normal);
        touch.force = law.normal_force(touch.overlap, approach, touch.mass);
        damping.power -= (touch.force - elastic) * approach;
        sum.add_at(&touch.arm, &(touch.normal * (touch.force - elastic)));
    }
    damping.stopping = stopping(body, &sum);
    let share = damping.share(dt);
    taken.damping.add(&sum.times(share));
    for touch in touches {
        let elastic = law.elastic_force(touch.overlap);
        touch.force = elastic + share * (touch.force - elastic);
        body.state.wall_energy += law.elastic_energy(touch.overlap);
        let force = touch.normal * touch.force;
        body.state.wall_load.add_at(&touch.arm, &force);
    }
}

/// Friction and rolling resistance, with the share of damping that takes energy; they are
/// the second part of the wall's load.
fn rub(body: &mut Body, touches: &[WallTouch], taken: &mut Taken, dt: f64) {
    let (mut springs, mut rolling) = (
        std::mem::take(&mut body.state.springs),
        std::mem::take(&mut body.state.rolling),
    );
    let law = &body.wall_law;
    let (velocity, spin) = (body.velocity(), body.angular_velocity());
    let radius = body.shape.sphero_radius();
    let (mut load, mut energy) = (Load::default(), 0.0);
    let (mut damping, mut sum) = (Damping::default(), Load::default());
    for touch in touches {
        let stiffness = law.tangential_stiffness(touch.overlap);
        let viscous = law.tangential_damping(touch.overlap, touch.mass);
        let across = |v: &Vec3| v - touch.normal * v.dot(&touch.normal);
        let mut resist = |spring: &mut Spring, velocity: Vec3, cap: f64| {
            let before = *spring;
            spring.stiffen(stiffness);
            let found = spring.resist(&before, &velocity, viscous, cap, dt);
            taken.lost += found.lost;
            energy += spring.energy();
            damping.power += found.viscous.dot(&velocity);
            [found.elastic, found.viscous]
        };
        let sliding = across(&(velocity + spin.cross(&touch.arm)));
        let cap = law.friction * touch.force;
        let [elastic, part] = resist(&mut springs[touch.place], sliding, cap);
        load.add_at(&touch.arm, &elastic);
        sum.add_at(&touch.arm, &part);
        if let Some(spring) = rolling.get_mut(touch.place) {
            let turning = across(&spin) * radius;
            let cap = body.rolling_friction * touch.force;
            let [elastic, part] = resist(spring, turning, cap);
            load.torque += elastic * radius;
            sum.torque += part * radius;
        }
    }
    damping.stopping = stopping(body, &sum);
    let damped = sum.times(damping.share(dt));
    taken.damping.add(&damped);
    load.add(&damped);
    body.state.wall_load.add(&load);
    body.state.wall_energy += energy;
    (body.state.springs, body.state.rolling) = (springs, rolling);
}

/// True if no wall reaches into the bounding ball.
fn clear_of(body: &Body, planes: &[Plane]) -> bool {
    !planes.iter().any(|plane| reaches(plane, body))
}

/// True if a wall reaches into the bounding ball.
fn reaches(plane: &Plane, body: &Body) -> bool {
    plane.height(&body.state.position) <= body.shape.bounding_radius()
}

#[cfg(test)]
mod tests;
