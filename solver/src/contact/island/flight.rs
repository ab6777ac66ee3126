//! Time in which no new contact of an island can begin: it is crossed in one body sub-step
//! (docs/method.md, equation 20a).

use super::member::Member;
use super::mover::Mover;
use super::pair::{IslandPair, Side, body_of};
use super::surroundings::Surroundings;
use crate::contact::body_body::{distance, least_gap};
use crate::contact::body_wall::ground_gap;
use crate::math::Vec3;
use crate::method::METHOD;
use crate::rigid::Body;
use crate::walls::Plane;

/// Largest share of a gap that is crossed: the rest is for rounding, and for the flow's torque,
/// which is kept at its value at the start.
const SHARE_OF_GAP: f64 = 0.9;

/// Upper bound of an approach: a speed [m/s] that grows by an acceleration [m/s²].
#[derive(Clone, Copy)]
struct Closing {
    speed: f64,
    acceleration: f64,
}

/// Time in which no new contact of an island can begin [s]; the search ends beyond `longest`
/// and below `least`.
pub(super) fn clear_for(
    members: &[Member],
    movers: &[Mover],
    contact_pairs: &[IslandPair],
    around: &Surroundings,
    (least, longest): (f64, f64),
) -> f64 {
    let mut time = longest;
    for member in members {
        time = time.min(METHOD.body_step.largest_turn / member.body.angular_velocity().norm());
        time = time.min(clear_of_walls(member, around, time));
    }
    for island_pair in contact_pairs {
        if time < least {
            break;
        }
        let both = island_pair.sides.map(|side| body_of(members, movers, side));
        let closing = closing_of_pair(members, movers, island_pair, &around.gravity);
        let by_faces = closing.clear_for(least_gap(both[0], both[1]));
        time = if by_faces < time {
            time.min(closing.clear_for(distance(both[0], both[1])))
        } else {
            time
        };
    }
    time
}

/// Lower bound of the time in which a body touches no wall [s]; the search ends beyond
/// `longest`.
fn clear_of_walls(member: &Member, around: &Surroundings, longest: f64) -> f64 {
    let body = &*member.body;
    let turning = turning(member);
    let linear = body.velocity();
    let acceleration = around.gravity + member.flow.force / body.mass;
    let towards = |plane: &Plane| Closing {
        speed: turning.speed - linear.dot(&plane.normal),
        acceleration: (turning.acceleration - acceleration.dot(&plane.normal)).max(0.0),
    };
    let on_ground = around.walls.terrain.map_or(longest, |ground| {
        let closing = Closing {
            speed: turning.speed + linear.norm(),
            acceleration: turning.acceleration + acceleration.norm(),
        };
        longest.min(closing.clear_for(ground_gap(body, ground)))
    });
    around.walls.planes.iter().fold(on_ground, |time, plane| {
        let closing = towards(plane);
        let height = plane.height(&body.state.position);
        if closing.clear_for(height - body.shape.bounding_radius()) >= time {
            return time;
        }
        let extent = body.shape.extent_along(&body.to_body(&-plane.normal));
        time.min(closing.clear_for(height - extent))
    })
}

/// Approach of two bodies.
fn closing_of_pair(
    members: &[Member],
    movers: &[Mover],
    island_pair: &IslandPair,
    gravity: &Vec3,
) -> Closing {
    let velocity = |side: Side| match side {
        Side::Member(place) => members[place].body.velocity(),
        Side::Barrier(_) | Side::Mover(_) => Vec3::zeros(),
    };
    let acceleration = |side: Side| match side {
        Side::Member(place) => gravity + members[place].flow.force / members[place].body.mass,
        Side::Barrier(_) | Side::Mover(_) => Vec3::zeros(),
    };
    let own = |side: Side| match side {
        Side::Member(place) => turning(&members[place]),
        Side::Barrier(_) => Closing::NONE,
        Side::Mover(place) => Closing {
            speed: movers[place].body.speed_ahead(),
            acceleration: 0.0,
        },
    };
    let [first, second] = island_pair.sides;
    let (one, other) = (own(first), own(second));
    Closing {
        speed: (velocity(first) - velocity(second)).norm() + one.speed + other.speed,
        acceleration: (acceleration(first) - acceleration(second)).norm()
            + one.acceleration
            + other.acceleration,
    }
}

/// Largest speed that free turning and the flow's torque can give to a place.
fn turning(member: &Member) -> Closing {
    let body: &Body = member.body;
    let largest = body.inverse_inertia.largest();
    Closing {
        speed: body.turning_bound(),
        acceleration: body.shape.bounding_radius() * largest * member.flow.torque.norm(),
    }
}

impl Closing {
    const NONE: Self = Self {
        speed: 0.0,
        acceleration: 0.0,
    };

    /// Time in which a share of a gap [m] is crossed [s]; 0 if there is none.
    fn clear_for(&self, gap: f64) -> f64 {
        let way = SHARE_OF_GAP * gap;
        let Self {
            speed,
            acceleration,
        } = *self;
        let reached = (speed * speed + 2.0 * acceleration * way.max(0.0)).sqrt();
        if speed > 0.0 {
            2.0 * way.max(0.0) / (speed + reached)
        } else if acceleration > 0.0 {
            (reached - speed) / acceleration
        } else {
            f64::INFINITY
        }
    }
}
