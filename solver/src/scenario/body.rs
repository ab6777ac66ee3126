//! Readers of the bodies.

use super::motion::read_motion;
use super::node::Node;
use super::range::short;
use super::reader::Object;
use super::report::Report;
use super::rules::*;
use super::shape::read_shape;
use super::sharp_shape::{SharpShape, Size};
use super::{Body, BuiltSolid, Place, Position, Shape};
use crate::shape::ShapeError;

/// The list of bodies; a refused body is `None`.
pub(super) fn read_bodies(parent: &Object<'_>, on_terrain: bool) -> Option<Vec<Option<Body>>> {
    let allowed = format!("a list of at most {BODIES} bodies");
    let pointer = parent.pointer_to("bodies");
    match parent.required("bodies", &allowed)? {
        Node::List(items) if items.len() <= BODIES => Some(
            items
                .iter()
                .enumerate()
                .map(|(index, node)| {
                    read_body(
                        node,
                        format!("{pointer}/{index}"),
                        parent.report,
                        on_terrain,
                    )
                })
                .collect(),
        ),
        _ => {
            let why = format!("must be {allowed}");
            parent.report.refuse(&pointer, &allowed, None, &why);
            None
        }
    }
}

fn read_body(node: &Node, pointer: String, report: &Report, on_terrain: bool) -> Option<Body> {
    let object = Object::open(node, pointer, report)?;
    let sharp = read_shape(&object);
    let size = sharp.as_ref().map(SharpShape::size);
    let shape = sharp.as_ref().map(SharpShape::shape);
    let sphero_radius_m = read_sphero_radius(&object, shape, size);
    let density_kg_m3 = object.number(&BODY_DENSITY);
    let position = object.defaulted("position").and_then(|o| match on_terrain {
        true => read_position_on_terrain(&o),
        false => read_position(&o, size),
    });
    let turn = read_turn(&object);
    let velocities = read_velocities(&object);
    let friction = object.number(&FRICTION);
    let restitution = object.number(&RESTITUTION);
    let rolling_friction = object.number(&ROLLING_FRICTION);
    let flow_friction = object.number(&FLOW_FRICTION);
    let flow_restitution = object.number(&FLOW_RESTITUTION);
    let contact_modulus_pa = object.automatic(&CONTACT_MODULUS);
    let fixed = object.flag("fixed", false);
    let motion = read_motion(&object);
    object.refuse_unknown();
    let solid = read_solid(&object, sharp.as_ref(), sphero_radius_m);
    let ((yaw_deg, orientation), (velocity_m_s, angular_velocity_rad_s)) = (turn?, velocities?);
    let body = Body {
        shape: shape?.clone(),
        sphero_radius_m: sphero_radius_m?,
        density_kg_m3: density_kg_m3?,
        position: position?,
        yaw_deg,
        orientation,
        velocity_m_s,
        angular_velocity_rad_s,
        friction: friction?,
        restitution: restitution?,
        rolling_friction: rolling_friction?,
        flow_friction: flow_friction?,
        flow_restitution: flow_restitution?,
        contact_modulus_pa: contact_modulus_pa?,
        fixed: fixed?,
        motion: motion?,
        // One that can't be rounded has been refused; what else is wrong with it is told, too.
        solid: solid.clone().unwrap_or_default(),
    };
    moves_one_way(&object, &body);
    solid.map(|_| body)
}

/// The sphero radius; a shape with one of its own takes no other.
fn read_sphero_radius(
    object: &Object<'_>,
    shape: Option<&Shape>,
    size: Option<Size>,
) -> Option<f64> {
    let Some(own) = shape.and_then(Shape::own_radius_m) else {
        let default = size.map(|size| size.thickness_m / SIZE_PER_SPHERO_RADIUS);
        return object.number_or(&SPHERO_RADIUS, default);
    };
    let given = object.number_or(&SPHERO_RADIUS, Some(own))?;
    if given == own {
        return Some(own);
    }
    let why = format!(
        "is {}, but the shape is round by its own radius_m ({}): leave it out",
        short(given),
        short(own)
    );
    let allowed = format!("{}, or left out", short(own));
    let pointer = object.pointer_to(SPHERO_RADIUS.key);
    object
        .report
        .refuse(&pointer, &allowed, SPHERO_RADIUS.unit, &why);
    None
}

fn read_position(object: &Object<'_>, size: Option<Size>) -> Option<Position> {
    let downstream_m = object.number_or(&DOWNSTREAM, size.map(|size| size.length_m));
    let lateral_m = object.number(&LATERAL);
    let elevation_m = object.automatic(&ELEVATION);
    object.refuse_unknown();
    Some(Position {
        place: Place::InChannel {
            downstream_m: downstream_m?,
            lateral_m: lateral_m?,
        },
        elevation_m: elevation_m?,
    })
}

fn read_position_on_terrain(object: &Object<'_>) -> Option<Position> {
    let (east_m, north_m) = (object.number(&EAST), object.number(&NORTH));
    let elevation_m = object.automatic(&TERRAIN_ELEVATION);
    object.refuse_unknown();
    Some(Position {
        place: Place::OnTerrain {
            east_m: east_m?,
            north_m: north_m?,
        },
        elevation_m: elevation_m?,
    })
}

/// Yaw and orientation, at most one of which is given.
fn read_turn(object: &Object<'_>) -> Option<(f64, Option<[f64; 4]>)> {
    let yaw_deg = object.number(&YAW);
    let orientation = match object.automatic_vector(&ORIENTATION)? {
        None => None,
        Some(quaternion) => Some(normalised(object, quaternion)?),
    };
    let yaw_deg = yaw_deg?;
    if yaw_deg != 0.0 && orientation.is_some() {
        let allowed = "0 while orientation is given";
        let why = "turns a body whose orientation is given: give one of the two";
        object
            .report
            .refuse(&object.pointer_to(YAW.key), allowed, YAW.unit, why);
        return None;
    }
    Some((yaw_deg, orientation))
}

/// A quaternion of unit length, if the given one is nearly so. One that is unit to rounding is
/// left as it is: reading a scenario twice changes nothing.
fn normalised(object: &Object<'_>, quaternion: [f64; 4]) -> Option<[f64; 4]> {
    let norm = quaternion
        .iter()
        .map(|part| part * part)
        .sum::<f64>()
        .sqrt();
    let error = (norm - 1.0).abs();
    if error > QUATERNION_SLACK {
        let allowed = format!("[w, x, y, z] of length 1 within {QUATERNION_SLACK}");
        let why = format!(
            "must be a unit quaternion, but its length is {}",
            short(norm)
        );
        object
            .report
            .refuse(&object.pointer_to(ORIENTATION.key), &allowed, None, &why);
        return None;
    }
    let scale = if error < 1e-12 { 1.0 } else { norm };
    Some(quaternion.map(|part| part / scale))
}

fn read_velocities(object: &Object<'_>) -> Option<([f64; 3], [f64; 3])> {
    let velocity = object.vector(&VELOCITY);
    let angular_velocity = object.vector(&ANGULAR_VELOCITY);
    Some((velocity?, angular_velocity?))
}

/// A body is free, fixed, or has a prescribed motion; only a free one may have initial
/// velocities of its own.
fn moves_one_way(object: &Object<'_>, body: &Body) {
    let why = match (body.fixed, &body.motion) {
        (true, Some(_)) => {
            let why = "can't be true, since the body's motion is given";
            let pointer = object.pointer_to("fixed");
            let allowed = "false while motion is given";
            object.report.refuse(&pointer, allowed, None, why);
            return;
        }
        (true, None) => "must be zero, since the body is fixed",
        (false, Some(_)) => "must be zero, since the body's motion is given",
        (false, None) => return,
    };
    let given = [
        (&VELOCITY, body.velocity_m_s),
        (&ANGULAR_VELOCITY, body.angular_velocity_rad_s),
    ];
    for (rule, _) in given.iter().filter(|(_, velocity)| *velocity != [0.0; 3]) {
        object
            .report
            .refuse(&object.pointer_to(rule.key), "[0, 0, 0]", rule.unit, why);
    }
}

/// The shape rounded with this radius, if it can be.
fn read_solid(
    object: &Object<'_>,
    sharp: Option<&SharpShape>,
    radius: Option<f64>,
) -> Option<BuiltSolid> {
    let radius = radius?;
    let error = match BuiltSolid::new(sharp?, radius) {
        Ok(solid) => return Some(solid),
        Err(error) => error,
    };
    let pointer = object.pointer_to(SPHERO_RADIUS.key);
    match error {
        ShapeError::RadiusNotBelowInradius { inradius_m, .. } => {
            let inradius = short(inradius_m);
            let why = format!(
                "is {}, not below the inradius {inradius} of the shape",
                short(radius)
            );
            object.report.refuse(
                &pointer,
                &format!("0 < x < {inradius}"),
                SPHERO_RADIUS.unit,
                &why,
            );
        }
        ShapeError::NoCore { allowed_m, .. } => {
            let allowed = format!("0 < x <= {allowed_m}");
            let why = format!("makes no solid: {error}");
            object
                .report
                .refuse(&pointer, &allowed, SPHERO_RADIUS.unit, &why);
        }
        other => {
            let allowed = "a radius that leaves a core";
            object.report.refuse(
                &pointer,
                allowed,
                SPHERO_RADIUS.unit,
                &format!("makes no solid: {other}"),
            );
        }
    }
    None
}
