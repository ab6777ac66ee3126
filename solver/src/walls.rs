//! The channel's walls: planes for bodies, and constraints on grid nodes.
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
mod search;
mod vertical_walls;

pub use crate::bed::Plane;
pub use boundary::{Boundary, BoundaryCounts, filled};
pub use constraint::WallPace;
pub use nodes::NodeAccess;
pub use vertical_walls::{Ends, VerticalBoundary, VerticalWalls};

/// All walls of the channel.
#[derive(Debug, Clone)]
pub struct Walls {
    /// The bed.
    pub bed: Arc<dyn Bed>,
    /// The vertical walls.
    pub vertical_walls: VerticalWalls,
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
    /// Every plane that a body can touch.
    pub fn planes(&self) -> impl Iterator<Item = &Plane> {
        let back = match &self.vertical_walls.ends {
            Ends::Back(bound) => Some(bound.plane()),
            Ends::Seam { .. } => None,
        };
        let sides = self
            .vertical_walls
            .sides
            .iter()
            .map(VerticalBoundary::plane);
        self.bed.planes().iter().chain(back).chain(sides)
    }
}

#[cfg(test)]
mod tests;
