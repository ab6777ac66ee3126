//! Symmetries of a scene, by which parts of it are images of others.

use super::{Columns, Setup};
use crate::contact::point_body::Around;
use crate::kernel::Lattice;
use crate::math::Vec3;
use crate::rigid::{Body, Freedom};
use crate::scenario::Scenario;

/// Rounding of a position, over the size of its body.
const ROUNDING: f64 = 1e-9;
/// Distance at which a body does not affect a flow for a step: a node's available volume
/// depends on bodies 1.5 cells away, a point depends on that node 1.5 cells away, and travels
/// less than half a cell. The reach of contacts is less.
const CLEAR_CELLS: f64 = 3.5;

/// Reason against a reduction.
pub(super) type Why = String;

/// Mirror image of each body, if flow and bodies are symmetric about the centre plane.
pub(super) fn partners(
    scenario: &Scenario,
    columns: &Columns,
    bodies: &[Body],
) -> Result<Vec<usize>, Why> {
    let rows = columns.count[1];
    if !rows.is_multiple_of(2) {
        return Err(format!(
            "{rows} rows of points lie across the channel: an odd number, so that one lies in the centre plane"
        ));
    }
    (0..bodies.len())
        .map(|place| partner(scenario, bodies, place))
        .collect()
}

fn partner(scenario: &Scenario, bodies: &[Body], place: usize) -> Result<usize, Why> {
    let body = &bodies[place];
    if mirrored_onto(body, body) {
        return if moves_in_plane(body) {
            Ok(place)
        } else {
            Err(format!(
                "body {place} moves out of the centre plane, or starts to"
            ))
        };
    }
    if body.freedom != Freedom::Fixed {
        return Err(format!(
            "body {place} is not symmetric about the centre plane"
        ));
    }
    let alike = |other: &usize| {
        let laws = bodies[*other].flow_law == body.flow_law;
        laws && scenario.bodies[*other].fixed && mirrored_onto(body, &bodies[*other])
    };
    (0..bodies.len())
        .find(alike)
        .ok_or_else(|| format!("the fixed body {place} has no mirror image"))
}

/// True if one body is the mirror image of the other.
fn mirrored_onto(body: &Body, other: &Body) -> bool {
    let size = body.shape.bounding_radius();
    let near = |a: &Vec3, b: &Vec3| (a - b).norm() <= ROUNDING * size;
    let place = |body: &Body, vertex: &Vec3| body.state.position + body.to_world(vertex);
    let others: Vec<Vec3> = other
        .shape
        .core_vertices()
        .iter()
        .map(|v| place(other, v))
        .collect();
    let vertices = body.shape.core_vertices();
    let found = |vertex: &Vec3| {
        let image = mirrored(&place(body, vertex));
        others.iter().any(|other| near(&image, other))
    };
    let radii = body.shape.sphero_radius() - other.shape.sphero_radius();
    vertices.len() == others.len() && radii.abs() <= ROUNDING * size && vertices.iter().all(found)
}

fn moves_in_plane(body: &Body) -> bool {
    if let Some(prescribed) = body.prescribed() {
        return prescribed.motion.stays_in_plane();
    }
    let (linear, turning) = (body.velocity(), body.angular_velocity());
    linear.y == 0.0 && turning.x == 0.0 && turning.z == 0.0
}

/// The mirror image of a place.
fn mirrored(x: &Vec3) -> Vec3 {
    Vec3::new(x.x, -x.y, x.z)
}

/// True if a flow is uniform across the channel at the start.
pub(super) fn uniform_across(
    scenario: &Scenario,
    columns: &Columns,
    given: &Setup,
    bodies: &[Body],
) -> Result<(), Why> {
    let channel = scenario.channel();
    let friction = channel.map_or(0.0, |channel| channel.side_friction);
    if friction > 0.0 {
        return Err(format!("the side walls rub, with a friction of {friction}"));
    }
    let moved = |body: &Body| body.prescribed().is_some() && body.speed_ahead() > 0.0;
    if let Some(place) = bodies.iter().position(moved) {
        return Err(format!("body {place} has a prescribed motion"));
    }
    let near = |body: &&Body| {
        let around = near_body(body, &given.lattice);
        columns.any_place(scenario, given.walls.bed.as_ref(), |x| around.holds(x))
    };
    match bodies.iter().position(|body| near(&body)) {
        Some(place) => Err(format!(
            "body {place} stands within {CLEAR_CELLS} cells of the release"
        )),
        None => Ok(()),
    }
}

/// Region that a flow unaffected by bodies must not enter, at any place across.
pub(in crate::simulation) fn near_body(body: &Body, lattice: &Lattice) -> Around {
    Around::body(body, CLEAR_CELLS * lattice.spacing.max()).all_across()
}
