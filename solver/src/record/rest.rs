//! Early-stop criterion: nothing that still moves can move a body or the front any more
//! (docs/method.md, equations 61–63).

use super::front::FrontMeasure;
use super::scale::Scale;
use crate::math::Vec3;
use crate::method::METHOD;
use crate::rigid::Body;
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
    /// Bound on the further outflow through the open end [kg]; null without a flow.
    #[serde(default)]
    pub outflow_bound_kg: Option<f64>,
}

/// Energies and reaches of the moving part of a flow.
pub(super) struct Remaining {
    /// Farthest place at which each computed point comes to rest [m], with the mass of itself and
    /// its images [kg].
    pub(super) reaches: Vec<(f64, f64)>,
    /// Mean place of the mass [m].
    pub(super) mass_centre: f64,
    moving: Vec<Sliding>,
}

/// A moving point and its images.
struct Sliding {
    /// Its place, by the measure of the front [m].
    place: f64,
    /// Distance from there that friction allows [m].
    way: f64,
    /// Kinetic energy, and potential energy on the incline [J].
    energy: f64,
}

impl Sliding {
    /// Energy that remains at a place after friction [J].
    fn energy_at(&self, place: f64) -> f64 {
        let spent = ((place - self.place) / self.way).clamp(0.0, 1.0);
        self.energy * (1.0 - spent)
    }
}

impl Remaining {
    /// Remaining energies of the points faster than `creep_speed` [m/s].
    pub(super) fn of(simulation: &Simulation, measure: &FrontMeasure, creep_speed: f64) -> Self {
        let gravity = simulation.gravity().norm();
        let mut remaining = Self {
            reaches: Vec::with_capacity(simulation.computed_points()),
            mass_centre: 0.0,
            // A list that grows would take up to three times its memory.
            moving: Vec::with_capacity(simulation.computed_points()),
        };
        let (mut moment, mut whole) = (0.0, 0.0);
        simulation.visit_computed_points(|point, mass| {
            let (x, y) = (point.position.x, point.position.y);
            let place = measure.of_place(&point.position);
            let mut way = 0.0;
            let speed = point.velocity.norm();
            if speed > creep_speed {
                // Equation 61.
                let height = simulation.bed().elevation(x, y);
                let specific = 0.5 * speed * speed + gravity * height;
                way = specific / (simulation.bed().tangent(x, y).flow_friction * gravity);
                let energy = mass * specific;
                remaining.moving.push(Sliding { place, way, energy });
            }
            moment += mass * place;
            whole += mass;
            remaining.reaches.push((place + way, mass));
        });
        remaining.mass_centre = if whole > 0.0 { moment / whole } else { 0.0 };
        remaining
    }

    /// Energy that reaches a place [J].
    fn energy_at(&self, place: f64) -> f64 {
        self.moving.iter().map(|point| point.energy_at(place)).sum()
    }
}

/// Largest distance that any of the bodies, which are at rest, can still move [m]: what each creeps
/// on by, and what the part of a flow that reaches it pushes it (equation 62); `None` if too large
/// or unbounded.
pub(super) fn body_bound(
    simulation: &Simulation,
    remaining: &Remaining,
    measure: &FrontMeasure,
    creeps_on: impl Fn(usize, &Body) -> f64,
) -> Option<f64> {
    let gravity = simulation.gravity().norm();
    let mut largest = 0.0f64;
    for (place, body) in simulation.bodies().iter().enumerate() {
        if !body.is_free() {
            continue;
        }
        // Material that comes to rest more than a cell before the body does not touch it.
        let behind = body.shape.bounding_radius() + simulation.cell_size_m();
        let energy = remaining.energy_at(measure.of_place(&body.state.position) - behind);
        let way = creeps_on(place, body) + pushed(body, simulation, energy)?;
        if way > Scale::of_body(body, gravity).onset_distance() {
            return None;
        }
        largest = largest.max(way);
    }
    Some(largest)
}

/// Distance that this energy [J] pushes a body [m] (equation 62).
fn pushed(body: &Body, simulation: &Simulation, energy: f64) -> Option<f64> {
    if energy <= 0.0 {
        return Some(0.0);
    }
    match Footing::of(body, simulation) {
        Some(footing) if energy < METHOD.early_stop.tipping_share * footing.tipping => {
            Some(energy / footing.holding)
        }
        Some(_) => None,
        // What lies on others or in a deposit is held by more than one wall; its weight alone is a
        // bound on what such a push does only while that hardly lifts it.
        None => {
            let weight = body.mass * simulation.gravity().norm();
            let lifted = energy / weight;
            let size = body.shape.volume().cbrt();
            (lifted < METHOD.early_stop.lift * size).then_some(lifted)
        }
    }
}

/// True if a front that could still advance this far [m] counts as at rest.
pub(super) fn front_rests(simulation: &Simulation, bound: f64) -> bool {
    bound <= METHOD.early_stop.front_bound * simulation.cell_size_m()
}

/// Mass of the points that reach the open end [kg] if each goes on as far as the front may [m], as
/// far as its present speed takes it in `left` [s], or as far as friction allows one faster than
/// creep.
pub(super) fn reaches_open_end(
    simulation: &Simulation,
    remaining: &Remaining,
    measure: &FrontMeasure,
    (front_bound, left): (f64, f64),
) -> f64 {
    let (mut leaving, mut reaches) = (0.0, remaining.reaches.iter());
    simulation.visit_computed_points(|point, mass| {
        let here = measure.of_place(&point.position);
        let farthest = reaches.next().map_or(here, |(reach, _)| *reach);
        let way = front_bound.max(point.velocity.norm() * left);
        if way.max(farthest - here) >= simulation.outlet().distance(&point.position) {
            leaving += mass;
        }
    });
    leaving
}

/// True if an outflow that could still grow by this mass [kg] counts as over.
pub(super) fn outflow_rests(simulation: &Simulation, bound: f64) -> bool {
    bound <= METHOD.early_stop.outflow_bound * simulation.audit().released_mass
}

/// Least bound on a front's advance [m]: a deposit at rest shifts a little within its cells.
pub(super) fn front_resolution(simulation: &Simulation) -> f64 {
    METHOD.early_stop.front_resolution * simulation.cell_size_m()
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
        let walls = simulation.rigid_walls().planes_under(&body.placed());
        walls
            .iter()
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
