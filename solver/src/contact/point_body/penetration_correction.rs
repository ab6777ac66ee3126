//! Penetration correction of points that ended a step inside a body's core.

use crate::math::Vec3;
use crate::rigid::Body;
use crate::shape::Face;
use crate::walls::{Plane, RigidWalls};

/// Correction of a point that ended a step inside a body's core.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PenetrationCorrection {
    /// New position of the point.
    To(Vec3),
    /// No position is free: walls leave no room over any face.
    NoRoom {
        /// Below the nearest face of the core [m].
        depth: f64,
    },
}

/// A point that stays inside a body's core.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PenetratingPoint {
    /// Identity of the point.
    pub point: u32,
    /// Index of the body.
    pub body: usize,
    /// Depth below the nearest face of the core [m].
    pub depth: f64,
}

impl PenetratingPoint {
    /// The deeper one of two.
    pub fn deeper(first: Option<Self>, second: Self) -> Option<Self> {
        Some(
            first
                .filter(|one| one.depth >= second.depth)
                .unwrap_or(second),
        )
    }
}

/// Correction of a point that ended a step inside a body's core: to a position over the nearest
/// face with room between the `walls`. `None` if the point is outside.
pub fn penetration_correction(
    position: &Vec3,
    body: &Body,
    walls: &RigidWalls,
) -> Option<PenetrationCorrection> {
    let arm = body.to_body(&(position - body.state.position));
    let distance = body.shape.closest_feature(&arm).distance;
    if distance >= 0.0 {
        return None;
    }
    let over = |face: &Face| {
        let depth = face.offset - face.normal.dot(&arm);
        let out = face.normal * (depth + body.shape.sphero_radius());
        (depth, position + body.to_world(&out))
    };
    // A point that was behind a wall before is at least not moved farther behind it.
    let walls = walls.planes_at(position);
    let has_room = |place: &Vec3| {
        let behind = |wall: &Plane| wall.height(place) < wall.height(position).min(0.0);
        !walls.iter().any(behind)
    };
    let places = body.shape.faces().iter().map(over);
    let nearest = places
        .filter(|(_, place)| has_room(place))
        .min_by(|one, other| one.0.total_cmp(&other.0));
    Some(match nearest {
        Some((_, place)) => PenetrationCorrection::To(place),
        None => PenetrationCorrection::NoRoom { depth: -distance },
    })
}
