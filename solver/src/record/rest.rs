//! Early-stop criterion: nothing can move a body or the front any more (docs/method.md,
//! equations 61–63).

use super::scale::Scale;
use crate::math::Vec3;
use crate::method::METHOD;
use crate::points::Point;
use crate::rigid::Body;
use crate::scenario::Scenario;
use crate::simulation::Simulation;
use crate::walls::Plane;
use serde::{Deserialize, Serialize};

/// Early stop of a run, with bounds on the changes that the rest of the run could have made.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct EndedEarly {
    /// Time of the early stop [s].
    pub time_s: f64,
    /// Reason for the early stop.
    pub reason: String,
    /// Bound on the further displacement of any body [m].
    pub body_bound_m: f64,
    /// Bound on the further advance of the front [m]; null without a flow.
    pub front_bound_m: Option<f64>,
}

/// Material of a flow that comes to rest on the bed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Resting {
    /// Static friction within it; `None` without a flow.
    friction: Option<f64>,
    /// Speed below which points are assumed to stay [m/s].
    still: f64,
}

impl Resting {
    pub(super) fn of(scenario: &Scenario) -> Self {
        let flow = scenario.flow.as_ref();
        let height = flow.map_or(0.0, |flow| flow.release.height_m);
        Self {
            friction: flow.map(|flow| flow.material.static_friction),
            still: METHOD.early_stop.still * (scenario.gravity_m_s2 * height).sqrt(),
        }
    }

    /// True if friction at rest, within the flow and on the bed, holds a point here.
    fn is_held(&self, on: &Plane) -> bool {
        let steepness = on.normal.xy().norm() / on.normal.z;
        let within = self.friction.unwrap_or(on.flow_friction);
        steepness == 0.0 || steepness < on.flow_friction.min(within)
    }
}

/// Energies and reaches of the moving part of a flow.
pub(super) struct Remaining {
    /// Farthest place at which each computed point comes to rest [m], with the mass of itself and
    /// its images [kg].
    pub(super) reaches: Vec<(f64, f64)>,
    moving: Vec<Sliding>,
}

/// A moving point and its images.
struct Sliding {
    /// Place along the channel [m].
    x: f64,
    /// Distance from there that friction allows [m].
    way: f64,
    /// Kinetic energy, and potential energy on the incline [J].
    energy: f64,
}

impl Sliding {
    /// Energy that remains at x after friction [J].
    fn energy_at(&self, x: f64) -> f64 {
        let spent = ((x - self.x) / self.way).clamp(0.0, 1.0);
        self.energy * (1.0 - spent)
    }
}

impl Remaining {
    /// Remaining energies for so much of the duration left [s].
    pub(super) fn of(simulation: &Simulation, resting: &Resting, left: f64) -> Self {
        let gravity = simulation.gravity().norm();
        let mut remaining = Self {
            reaches: Vec::with_capacity(simulation.computed_points()),
            // A list that grows would take up to three times its memory.
            moving: Vec::with_capacity(simulation.computed_points()),
        };
        simulation.visit_computed_points(|point, mass| {
            let (x, y) = (point.position.x, point.position.y);
            let on = simulation.bed().tangent(x, y);
            let specific = specific_energy(point, simulation, (&on, resting));
            let mut way = 0.0;
            if specific > 0.0 {
                way = specific / (on.flow_friction * gravity);
                let energy = mass * specific;
                remaining.moving.push(Sliding { x, way, energy });
            }
            // A point that creeps, pushed by others, need not slow down.
            let reach = x + way.max(point.velocity.norm() * left);
            remaining.reaches.push((reach, mass));
        });
        remaining
    }

    /// Energy that reaches x [J].
    fn energy_at(&self, x: f64) -> f64 {
        self.moving.iter().map(|point| point.energy_at(x)).sum()
    }
}

/// Energy that a moving point can still spend [J/kg]: its kinetic energy, and the height of the
/// bed under it (equation 61).
fn specific_energy(
    point: &Point,
    simulation: &Simulation,
    (on, resting): (&Plane, &Resting),
) -> f64 {
    let speed = point.velocity.norm();
    if speed < resting.still && resting.is_held(on) {
        return 0.0;
    }
    let (x, y) = (point.position.x, point.position.y);
    0.5 * speed * speed + simulation.gravity().norm() * simulation.bed().elevation(x, y)
}

/// Largest distance that any of these bodies, which are at rest, can still move in `left` [s],
/// by itself and pushed by the part of a flow that reaches it [m] (equation 62); `None` if too
/// large or unbounded.
pub(super) fn body_bound(simulation: &Simulation, remaining: &Remaining, left: f64) -> Option<f64> {
    let free = simulation.bodies().iter().filter(|body| body.is_free());
    let gravity = simulation.gravity().norm();
    let mut largest = 0.0f64;
    for body in free {
        let scale = Scale::of_body(body, gravity);
        // A body at rest that trembles faster than that goes nowhere.
        let mut way = body.largest_speed().min(scale.rest_speed()) * left;
        // Material that comes to rest more than a cell before the body does not touch it.
        let behind = body.shape.bounding_radius() + simulation.cell_size_m();
        let energy = remaining.energy_at(body.state.position.x - behind);
        if energy > 0.0 {
            let footing = Footing::of(body, simulation)?;
            if energy >= METHOD.early_stop.tipping_share * footing.tipping {
                return None;
            }
            way += energy / footing.holding;
        }
        if way > scale.onset_distance() {
            return None;
        }
        largest = largest.max(way);
    }
    Some(largest)
}

/// True if a front that could still advance this far [m] counts as at rest.
pub(super) fn front_rests(simulation: &Simulation, bound: f64) -> bool {
    bound <= METHOD.early_stop.front_bound * simulation.cell_size_m()
}

/// Support of a body on a wall.
struct Footing {
    /// Remaining friction force along the wall [N].
    holding: f64,
    /// Energy to tip it over an edge [J].
    tipping: f64,
}

impl Footing {
    /// Support of a body on three vertices or more of one plane, where friction holds it.
    fn of(body: &Body, simulation: &Simulation) -> Option<Self> {
        let planes = simulation.planes().iter();
        planes
            .filter_map(|plane| Self::on(plane, body, simulation.gravity()))
            .next()
    }

    fn on(plane: &Plane, body: &Body, gravity: Vec3) -> Option<Self> {
        let centre = body.state.position;
        let height = plane.height(&centre);
        let reach = body.shape.sphero_radius();
        let vertices = body.shape.core_vertices().iter();
        let places = vertices.map(|vertex| centre + body.to_world(vertex));
        let feet: Vec<Vec3> = places.filter(|place| plane.height(place) < reach).collect();
        let pressed = -gravity.dot(&plane.normal) * body.mass;
        if feet.len() < 3 || pressed <= 0.0 {
            return None;
        }
        // Intersection of the weight's line of action with the plane.
        let foot = centre + gravity * (body.mass * height / pressed);
        let margin = inside_by(&feet, &foot, &plane.normal)?;
        let pull = (gravity * body.mass + plane.normal * pressed).norm();
        let holding = body.wall_law.friction * pressed - pull;
        let rise = margin.hypot(height) - height;
        (holding > 0.0).then_some(Self {
            holding,
            tipping: pressed * rise,
        })
    }
}

/// Depth of a place inside the hull of some places, seen along `normal` [m]; `None`
/// outside.
fn inside_by(places: &[Vec3], place: &Vec3, normal: &Vec3) -> Option<f64> {
    let mut least = f64::INFINITY;
    for a in places {
        for b in places {
            let Some(inward) = normal.cross(&(b - a)).try_normalize(f64::EPSILON) else {
                continue;
            };
            let left = |x: &Vec3| inward.dot(&(x - a));
            // An edge has no place on its other side.
            if places.iter().all(|x| left(x) >= -1e-9) {
                least = least.min(left(place));
            }
        }
    }
    (least > 0.0 && least.is_finite()).then_some(least)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_as_far_inside_as_the_nearest_edge() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        let places = square.map(|[x, y]| Vec3::new(x, y, 0.0));
        let inside = |x, y| inside_by(&places, &Vec3::new(x, y, 0.3), &Vec3::z());
        assert_eq!(inside(1.0, 0.25), Some(0.25));
        assert_eq!(
            inside(1.9, 1.0).map(|by| (by * 1e9).round() / 1e9),
            Some(0.1)
        );
        assert_eq!(inside(2.1, 1.0), None);
        assert_eq!(inside_by(&places[..2], &places[0], &Vec3::z()), None);
    }
}
