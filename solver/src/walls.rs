//! The walls: planes for bodies, and constraints on grid nodes.
//!
//! The flow lies above the bed and between the vertical walls. The vertical walls lie on grid
//! planes and act as mirrors: a node and its images move as one, so a smooth wall reflects
//! exactly (docs/method.md, equation 28). The bed acts on columns of nodes at their intersection
//! with it (equation 29).

use crate::bed::Bed;
use crate::math::Vec3;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

mod boundary;
mod columns;
mod constraint;
mod nodes;
mod rigid_walls;
mod search;
mod vertical_walls;

pub use crate::bed::Plane;
pub use boundary::{Boundary, BoundaryCounts, filled};
pub use constraint::WallPace;
pub use nodes::NodeAccess;
pub use rigid_walls::{PlanesAt, RigidWalls};
pub use vertical_walls::{Ends, VerticalBoundary, VerticalWalls};

/// All walls: the bed, and those of a channel.
#[derive(Debug, Clone)]
pub struct Walls {
    /// The bed.
    pub bed: Arc<dyn Bed>,
    /// The vertical walls; `None` on open terrain.
    pub vertical_walls: Option<VerticalWalls>,
}

/// Impulse of the walls, linear [N s] and angular about the origin [N m s].
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Impulse {
    /// Linear [N s].
    pub linear: Vec3,
    /// Angular about the origin [N m s].
    pub angular: Vec3,
}

impl Impulse {
    /// Adds an impulse `linear` that acts at `x`.
    pub fn add_at(&mut self, x: &Vec3, linear: &Vec3) {
        self.linear += linear;
        self.angular += x.cross(linear);
    }

    /// The sum of both.
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            linear: self.linear + other.linear,
            angular: self.angular + other.angular,
        }
    }

    /// Sum over so many images, which lie symmetrically about the plane y = 0: doubled in the plane
    /// for two, and zero across it. One image leaves it unchanged.
    pub fn of_images(&self, count: f64) -> Self {
        if count == 1.0 {
            return *self;
        }
        Self {
            linear: in_plane(&self.linear) * count,
            angular: Vec3::new(0.0, self.angular.y * count, 0.0),
        }
    }
}

/// In-plane part of a vector, which remains in the sum with its mirror image in the plane y =
/// 0.
pub fn in_plane(v: &Vec3) -> Vec3 {
    Vec3::new(v.x, 0.0, v.z)
}

impl Walls {
    /// Half cells between the side walls; 0 without any.
    pub fn halves_across(&self) -> i32 {
        let vertical_walls = self.vertical_walls.as_ref();
        vertical_walls.map_or(0, |walls| walls.halves_across)
    }

    /// Every plane that a body can touch.
    pub fn planes(&self) -> impl Iterator<Item = &Plane> {
        let vertical_walls = self.vertical_walls.iter();
        let of_channel = vertical_walls.flat_map(VerticalWalls::planes);
        self.bed.planes().iter().chain(of_channel)
    }
}

#[cfg(test)]
mod tests;
