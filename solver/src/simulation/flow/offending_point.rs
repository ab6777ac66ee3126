//! Bounds of a flow's points, and the fault of a point beyond them.

use crate::points::Point;
use crate::walls::{Plane, RigidWalls};

/// Bounds of the points.
#[derive(Debug, Clone, Copy)]
pub(in crate::simulation) struct Bounds<'a> {
    /// The walls.
    pub walls: RigidWalls<'a>,
    /// Largest distance of a point behind a wall [m].
    pub tolerance: f64,
    /// Largest density [kg/m³].
    pub densest: f64,
}

/// Fault of a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::simulation) enum OffendingPoint {
    /// A non-finite quantity.
    NonFinite {
        /// Identity of the point.
        point: u32,
        /// Name of the quantity.
        quantity: &'static str,
    },
    /// It is behind a wall.
    BehindWall {
        /// Identity of the point.
        point: u32,
        /// Name of the wall.
        wall: &'static str,
        /// Depth [m].
        depth_m: f64,
    },
    /// It is too dense.
    Crushed {
        /// Identity of the point.
        point: u32,
        /// Its density [kg/m³].
        density: f64,
    },
}

impl OffendingPoint {
    /// Fault of a point, if it has any.
    pub(super) fn of(point: &Point, bounds: &Bounds) -> Option<Self> {
        if let Some(quantity) = point.non_finite() {
            return Some(Self::NonFinite {
                point: point.id,
                quantity,
            });
        }
        if point.density() > bounds.densest {
            return Some(Self::Crushed {
                point: point.id,
                density: point.density(),
            });
        }
        let behind = |plane: &&Plane| plane.height(&point.position) < -bounds.tolerance;
        let walls = bounds.walls.planes_at(&point.position);
        let mut walls = walls.iter();
        walls.find(behind).map(|plane| Self::BehindWall {
            point: point.id,
            wall: plane.name,
            depth_m: -plane.height(&point.position),
        })
    }
}
