//! Number of body sub-steps of an island within one of the flow (docs/method.md, equations 20
//! and 48).

use super::member::Member;
use super::mover::Mover;
use super::neighbours::{Reaches, reach, speed_within};
use super::pair::{IslandPair, Side, body_of};
use super::surroundings::Surroundings;
use crate::contact::body_body::{ContactPair, pair_law, reduced_mass};
use crate::contact::body_wall::deepest_overlap;
use crate::contact::law::ContactLaw;
use crate::math::Vec3;
use crate::method::METHOD;
use crate::rigid::{Body, Freedom, Load};
use crate::walls::RigidWalls;

/// Number of body sub-steps required for `dt`, whole but kept as a float.
pub(super) fn substeps(
    members: &[Member],
    movers: &[Mover],
    contact_pairs: &[IslandPair],
    around: &Surroundings,
    dt: f64,
) -> f64 {
    let alone = members.iter().map(|member| {
        let acceleration = member
            .body
            .largest_acceleration(&around.gravity, &member.flow);
        substeps_alone(member.body, &around.walls, acceleration, dt, dt)
    });
    let island_pair = contact_pairs.iter().map(|island_pair| {
        substeps_of_island_pair(members, movers, island_pair, &around.gravity, dt)
    });
    let count = alone.chain(island_pair).fold(0.0, f64::max);
    count.ceil().max(1.0)
}

/// Sub-steps that a body needs within `dt` for its spin and for the walls that it may
/// touch in the time `ahead` [s], under this acceleration [m/s²].
pub(super) fn substeps_alone(
    body: &Body,
    walls: &RigidWalls,
    acceleration: f64,
    dt: f64,
    ahead: f64,
) -> f64 {
    let turns = body.angular_velocity().norm() * dt / METHOD.body_step.largest_turn;
    // A body that starts from rest is not at rest at the end.
    let speed = body.largest_speed() + acceleration * dt;
    let reach = reach(body, speed_within(body, acceleration, ahead), ahead);
    let deepest = deepest_overlap(body, walls, reach);
    let contacts = if deepest + reach > 0.0 {
        let law = &body.wall_law;
        let impact = impact_overlap(law, body.mass, speed);
        dt / longest(law, deepest.max(impact), body.least_effective_mass())
    } else {
        0.0
    };
    turns.max(contacts)
}

/// Sub-steps that bodies need within `dt`, falling freely, for their spin and for everything
/// that they may touch in a `step` [s] that begins now.
pub fn substeps_ahead(
    bodies: &[Body],
    contact_pairs: &[ContactPair],
    around: &Surroundings,
    dt: f64,
    step: f64,
) -> f64 {
    let falling = |body: &Body| body.largest_acceleration(&around.gravity, &Load::default());
    let free = bodies.iter().filter(|body| body.is_free());
    let alone = free.map(|body| substeps_alone(body, &around.walls, falling(body), dt, step));
    let pairs = Reaches::within(bodies, |place| falling(&bodies[place]), step).pairs(bodies);
    let island_pair = pairs.into_iter().map(|pair| {
        let both = pair.map(|place| &bodies[place]);
        let known = contact_pairs
            .iter()
            .find(|contact_pair| contact_pair.bodies == pair);
        let deepest = known.map_or(0.0, |contact_pair| contact_pair.deepest);
        let gained = both.into_iter().map(|body| falling(body) * dt).sum();
        substeps_of_pair(both, &pair_law(both[0], both[1]), deepest, gained, dt)
    });
    alone.chain(island_pair).fold(0.0, f64::max)
}

/// Sub-steps that two bodies need.
fn substeps_of_island_pair(
    members: &[Member],
    movers: &[Mover],
    island_pair: &IslandPair,
    gravity: &Vec3,
    dt: f64,
) -> f64 {
    let both = island_pair.sides.map(|side| body_of(members, movers, side));
    let gained = island_pair.sides.iter().map(|side| match side {
        Side::Member(place) => {
            let Member { body, flow, .. } = &members[*place];
            body.largest_acceleration(gravity, flow) * dt
        }
        Side::Barrier(_) | Side::Mover(_) => 0.0,
    });
    substeps_of_pair(
        both,
        &island_pair.law,
        island_pair.contact_pair.deepest,
        gained.sum(),
        dt,
    )
}

/// Sub-steps that two bodies need with contacts of this depth [m], whose approach speed grows
/// by `gained` [m/s] at most.
fn substeps_of_pair(both: [&Body; 2], law: &ContactLaw, deepest: f64, gained: f64, dt: f64) -> f64 {
    let speeds = both.into_iter().map(|body| match body.freedom {
        Freedom::Fixed => 0.0,
        Freedom::Free | Freedom::InPlane | Freedom::Prescribed(_) => body.speed_ahead(),
    });
    let speed = gained + speeds.sum::<f64>();
    let impact = impact_overlap(law, reduced_mass(both[0], both[1]), speed);
    let free = both.into_iter().filter(|body| body.is_free());
    let inverse: f64 = free.map(|body| 1.0 / body.least_effective_mass()).sum();
    let deepest = deepest.max(impact);
    if deepest > 0.0 {
        dt / longest(law, deepest, 1.0 / inverse)
    } else {
        0.0
    }
}

/// Sub-steps of its own that a body takes within a duration [s] if it lies on a wall all the
/// time, under this acceleration [m/s²].
pub fn substeps_at_rest(body: &Body, acceleration: f64, duration: f64) -> f64 {
    let law = &body.wall_law;
    let overlap = (body.mass * acceleration / law.stiffness).powf(2.0 / 3.0);
    duration / longest(law, overlap, body.least_effective_mass())
}

/// Largest speed of any two places of two bodies relative to each other [m/s].
pub(super) fn relative_speed(both: [&Body; 2]) -> f64 {
    let turning = |body: &Body| match body.freedom {
        Freedom::Fixed => 0.0,
        Freedom::Prescribed(_) => body.speed_ahead(),
        Freedom::Free | Freedom::InPlane => {
            body.angular_velocity().norm() * body.shape.bounding_radius()
        }
    };
    let linear = |body: &Body| {
        if body.is_free() {
            body.velocity()
        } else {
            Vec3::zeros()
        }
    };
    let [first, second] = both;
    (linear(first) - linear(second)).norm() + turning(first) + turning(second)
}

/// Longest body sub-step with a contact this deep [m] that moves this mass [kg] [s].
pub(super) fn longest(law: &ContactLaw, deepest: f64, mass: f64) -> f64 {
    let damped = (law.damping / METHOD.body_step.damped).min(1.0);
    let share = METHOD.body_step.undamped_share
        + damped * (METHOD.body_step.contact_share - METHOD.body_step.undamped_share);
    share * law.time_scale(deepest, mass)
}

/// Depth of a Hertz impact [m].
fn impact_overlap(law: &ContactLaw, mass: f64, speed: f64) -> f64 {
    (1.25 * mass * speed * speed / law.stiffness).powf(0.4)
}
