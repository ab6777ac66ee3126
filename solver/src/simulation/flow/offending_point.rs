//! Bounds of a flow's points, and the fault of a point beyond them.

use crate::bed::{Bed, HeightField};
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
        let behind = |plane: &Plane| Self::behind(plane, point, bounds.tolerance);
        let in_terrain = |ground: &HeightField| {
            // Along the vertical nothing is less deep than along the normal.
            let depth = ground.elevation(point.position.x, point.position.y) - point.position.z;
            let is_suspect = depth > bounds.tolerance;
            is_suspect.then(|| ground.nearest_plane(&point.position))
        };
        let of_terrain = || bounds.walls.terrain.and_then(in_terrain);
        let of_planes = bounds.walls.planes.iter().find_map(behind);
        of_planes.or_else(|| of_terrain().as_ref().and_then(behind))
    }

    fn behind(plane: &Plane, point: &Point, tolerance: f64) -> Option<Self> {
        let depth_m = -plane.height(&point.position);
        (depth_m > tolerance).then_some(Self::BehindWall {
            point: point.id,
            wall: plane.name,
            depth_m,
        })
    }
}
