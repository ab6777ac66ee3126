//! Rules of a scenario on a terrain: its releases and bodies lie on the map, and fit it.

use super::agreement::{Course, flow_is_stiff_enough, samples_are_bounded};
use super::duration::duration_to;
use super::fit::{Placed, bodies_are_apart};
use super::range::short;
use super::releases_fit::{extent_in_words, is_on_the_map, releases_fit, releases_happen};
use super::report::Report;
use super::rules::{CELL_SIZE, ELEVATION};
use super::{Scenario, SlidingPoints, Terrain};
use crate::bed::HeightField;

/// Least number of cells along the shorter side of a map.
const FEWEST_CELLS: f64 = 4.0;

/// Finishes a scenario on a terrain, whose fields are all valid: its default duration, and the rules
/// between its fields. A scenario in a channel is left as it is.
pub(super) fn finish(report: &Report, scenario: &mut Scenario, duration_is_given: bool) {
    if scenario.terrain().is_none() {
        return;
    }
    check(report, scenario);
    if duration_is_given {
        releases_happen(report, scenario);
    }
    if !report.is_empty() {
        return;
    }
    let course = course_of(scenario);
    if !duration_is_given {
        // Points that slide are not found in every narrow release.
        let latest = scenario.release_times().fold(0.0, f64::max);
        let rests_at = course.map(|course| course.rests_at.max(latest));
        scenario.duration_s = duration_to(rests_at, scenario.bodies.iter()).max(latest);
    }
    let (duration, interval) = (scenario.duration_s, scenario.sample_interval_s);
    samples_are_bounded(report, duration, interval, scenario.bodies.len());
    if let (Some(flow), Some(course)) = (&scenario.flow, course) {
        let course = Course {
            thickness: scenario.release_thickness_m().unwrap_or_default(),
            fastest: course.fastest,
        };
        let bodies: Vec<_> = scenario.bodies.iter().cloned().map(Some).collect();
        let (numerics, gravity) = (&scenario.numerics, scenario.gravity_m_s2);
        flow_is_stiff_enough(report, flow, &course, &bodies, numerics, gravity);
    }
}

/// Expected course of the flow, if there is one.
fn course_of(scenario: &Scenario) -> Option<SlidingPoints> {
    let terrain = scenario.terrain()?;
    SlidingPoints::of(scenario, &terrain.ground(scenario.cell_size_m()))
}

/// Refuses what does not fit the terrain.
fn check(report: &Report, scenario: &Scenario) {
    let Some(terrain) = scenario.terrain() else {
        return;
    };
    releases_fit(report, scenario, terrain);
    if !report.is_empty() {
        return;
    }
    let cell_size = scenario.cell_size_m();
    let shortest = terrain.extent().into_iter().fold(f64::INFINITY, f64::min);
    if cell_size * FEWEST_CELLS > shortest {
        let largest = short(shortest / FEWEST_CELLS);
        let why = format!(
            "is {}, too coarse for a map whose shorter side is {} m",
            short(cell_size),
            short(shortest)
        );
        let pointer = format!("/numerics/{}", CELL_SIZE.key);
        report.refuse(
            &pointer,
            &format!("0 < x <= {largest}"),
            CELL_SIZE.unit,
            &why,
        );
        return;
    }
    bodies_fit(report, scenario, terrain, &terrain.ground(cell_size));
}

/// Bodies lie on the map, above the ground and apart.
fn bodies_fit(report: &Report, scenario: &Scenario, terrain: &Terrain, ground: &HeightField) {
    let extent = terrain.extent();
    let bodies = scenario.bodies.iter().enumerate();
    let placed: Vec<Placed<'_>> = bodies
        .map(|(index, body)| {
            let shape = scenario.shape_of(index);
            let pose = body.pose_on(&shape, terrain, ground);
            Placed::new(index, body, shape, pose)
        })
        .collect();
    for of in &placed {
        let position = of.pose.position;
        let reach = of.shape.bounding_radius();
        let low = [position.x - reach, position.y - reach];
        let high = [position.x + reach, position.y + reach];
        if !is_on_the_map(low, extent) || !is_on_the_map(high, extent) {
            let [x, y] = of.body.position.place.coordinates();
            let why = format!(
                "is [{}, {}], less than the body's bounding radius ({} m) from the edge of the map",
                short(x),
                short(y),
                short(reach)
            );
            let pointer = format!("{}/position", of.pointer);
            report.refuse(&pointer, &extent_in_words(terrain), Some("m"), &why);
            continue;
        }
        let lowest = ground.lowest_centre(&of.shape, of.pose.orientation, position.x, position.y);
        let clearance = position.z - lowest;
        is_above_the_ground(report, of, clearance);
        // A given contact modulus carries its body at rest, and after a fall from its start.
        of.refuse_soft_contact(report, clearance, scenario.gravity_m_s2);
    }
    bodies_are_apart(report, &placed);
}

fn is_above_the_ground(report: &Report, placed: &Placed<'_>, clearance: f64) {
    let Some(elevation) = placed.body.position.elevation_m else {
        return;
    };
    if clearance >= -placed.slack {
        return;
    }
    let bound = elevation - clearance;
    let why = format!(
        "is {}, which puts the body into the ground: its centre must be at {} m or higher",
        short(elevation),
        short(bound)
    );
    let pointer = placed.pointer_to(ELEVATION.key);
    report.refuse(
        &pointer,
        &format!("x >= {}", short(bound)),
        ELEVATION.unit,
        &why,
    );
}
