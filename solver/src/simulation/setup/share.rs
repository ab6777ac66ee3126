//! Computed share of the flow (docs/method.md, section 12).

use super::{Columns, Setup};
use crate::math::Vec3;
use crate::walls::{Plane, VerticalBoundary, Walls};
use serde::{Deserialize, Serialize};

/// Share of the flow that is computed; images stand for the rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "lowercase")]
pub enum Share {
    /// The full flow.
    Whole,
    /// The right half, with a symmetry plane.
    Half,
    /// A quasi-2D slab: one cell next to the right wall.
    Slab,
}

impl Share {
    /// Computed width in half cells, of this many between the side walls.
    pub fn halves_across(self, whole: i32) -> i32 {
        match self {
            Self::Whole => whole,
            Self::Half => whole / 2,
            Self::Slab => 2,
        }
    }

    /// Computed rows of points across, of all in the release.
    pub fn rows_across(self, columns: &Columns, whole: i32) -> u32 {
        columns.count[1] * self.halves_across(whole).unsigned_abs() / whole.unsigned_abs().max(1)
    }

    /// The walls of this share of a channel.
    pub(in crate::simulation) fn walls(self, whole: &Setup) -> Walls {
        let mut walls = whole.walls.clone();
        let Some(vertical_walls) = &mut walls.vertical_walls else {
            return walls;
        };
        let halves = self.halves_across(vertical_walls.halves_across);
        if halves < vertical_walls.halves_across {
            let lattice = &whole.lattice;
            vertical_walls.halves_across = halves;
            vertical_walls.sides[1] = VerticalBoundary::Symmetry(Plane {
                name: "plane of symmetry",
                normal: -Vec3::y(),
                offset: -(lattice.origin.y + 0.5 * f64::from(halves) * lattice.spacing.y),
                flow_friction: 0.0,
            });
        }
        walls
    }
}

/// Computed shares of a flow, one after the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Shares {
    /// Share at the start.
    pub first: Share,
    /// Share once the flow has come near a body.
    pub last: Share,
    /// Division of the whole release into points.
    pub columns: Columns,
    /// Mirror image of each body, if half of the flow is computed.
    pub partners: Vec<usize>,
}
