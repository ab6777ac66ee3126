//! Outlook of a running simulation: when it is expected to come to rest.

use super::recorder::Recorder;
use super::scale::Scale;
use crate::points::Point;
use crate::rigid::Body;
use crate::scenario::Ending;
use crate::simulation::Simulation;

/// Share of the flow that may still move once it has come to rest.
const LAST: f64 = 0.02;
/// Weight of the plan's end beside that from present speeds, while all of the flow moves.
const PLAN_COUNTS: f64 = 0.5;
/// Largest number of points looked at.
const MOST_POINTS: usize = 10_000;
/// Time that a run goes on over the time by which it has exceeded its planned end.
const GOES_ON: f64 = 0.5;

impl Recorder {
    /// Time at which the run is expected to end [s], from the plan as long as most of the flow moves,
    /// and from the present speeds: what moves of the flow slides down to the foot and is stopped by
    /// friction on the floor, and so is each body. A round body is expected to roll to the end of
    /// the duration.
    pub fn expected_end_s(&self, simulation: &Simulation) -> f64 {
        let now = simulation.time_s();
        let (duration, planned) = (self.duration_s(), self.plan().cost.expected_end_s);
        if self.ending() == Ending::Full || self.moves_to_the_end(simulation) {
            return duration;
        }
        let rest_time = self.scale().rest_time();
        if now < rest_time {
            return planned.max(now + rest_time).min(duration);
        }
        let bodies = simulation.bodies().iter().enumerate();
        let moving = bodies.filter(|(place, body)| body.is_free() && !self.rests(*place, body));
        let stopping = moving.map(|(_, body)| stops_in(body, simulation));
        let flow = Settling::of(simulation, self.creep_speed());
        // What creeps and does not end the run is expected to go on for a part of its delay.
        let left = stopping
            .fold(flow.time, f64::max)
            .max(GOES_ON * (now - planned));
        let at_present = now + rest_time + left;
        // The mean is early and the plan is late; between them is where most runs end.
        let plan_counts = PLAN_COUNTS * flow.moving;
        let expected = at_present + plan_counts * (planned.max(now + rest_time) - at_present);
        expected.min(duration)
    }

    /// True if a body is expected to move as long as the run lasts.
    fn moves_to_the_end(&self, simulation: &Simulation) -> bool {
        let (now, planned) = (simulation.time_s(), self.plan().cost.expected_end_s);
        let bodies = simulation.bodies().iter().enumerate();
        let mut moving = bodies.filter(|(place, body)| match body.prescribed() {
            Some(prescribed) => !prescribed.motion.rests_from(planned.max(now)),
            None => body.is_free() && is_round(body) && !self.rests(*place, body),
        });
        moving.next().is_some()
    }
}

/// True of a ball or a capsule, which rolls on a floor without end.
fn is_round(body: &Body) -> bool {
    body.shape.core_vertices().len() < 3
}

/// Time in which friction on the floor stops a body [s].
fn stops_in(body: &Body, simulation: &Simulation) -> f64 {
    let gravity = simulation.gravity().norm();
    let braking = body.wall_law.friction * gravity;
    let rest_time = Scale::of_body(body, gravity).rest_time();
    body.velocity().norm() / braking + rest_time
}

/// Rest of a flow's motion.
struct Settling {
    /// Share of the mass that moves; 0 if that is no more than the last of it.
    moving: f64,
    /// Mean of the times in which friction alone would stop the moving mass [s]. What comes last
    /// finds the deposit in its way.
    time: f64,
}

impl Settling {
    fn of(simulation: &Simulation, creep_speed: f64) -> Self {
        let every = simulation.computed_points().div_ceil(MOST_POINTS).max(1);
        let (mut place, mut whole, mut moving, mut moment) = (0, 0.0, 0.0, 0.0);
        simulation.visit_computed_points(|point, mass| {
            place += 1;
            if place % every != 0 {
                return;
            }
            whole += mass;
            if point.velocity.norm() > creep_speed {
                moving += mass;
                moment += mass * slides_for(point, simulation);
            }
        });
        if moving <= LAST * whole {
            return Self {
                moving: 0.0,
                time: 0.0,
            };
        }
        Self {
            moving: moving / whole,
            time: moment / moving,
        }
    }
}

/// Time in which a point slides to the foot and is stopped on the floor [s].
fn slides_for(point: &Point, simulation: &Simulation) -> f64 {
    let gravity = simulation.gravity().norm();
    let (bed, at) = (simulation.bed(), &point.position);
    let on = bed.tangent(at.x, at.y);
    let (cos, sin) = (on.normal.z, on.normal.xy().norm());
    let height = bed.elevation(at.x, at.y);
    let pull = gravity * (sin - on.flow_friction * cos);
    let speed = point.velocity.norm();
    if sin == 0.0 || pull <= 0.0 {
        return speed / -pull.min(-f64::EPSILON);
    }
    let way = height / sin;
    let at_foot = (speed * speed + 2.0 * pull * way).sqrt();
    let sliding = (at_foot - speed) / pull;
    sliding + at_foot * cos / (on.flow_friction * gravity)
}
