//! Division of a release into points, in a channel or on a terrain.

use super::{Columns, Setup, Share, TerrainColumns};
use crate::points::Point;
use crate::rigid::Body;
use crate::scenario::Scenario;

/// Division of a release into points.
#[derive(Debug, Clone, PartialEq)]
pub enum Division {
    /// In a channel.
    Channel(Columns),
    /// On a terrain.
    Terrain(TerrainColumns),
}

impl Division {
    /// Number of points, including those excluded by a body.
    pub fn points(&self) -> u64 {
        match self {
            Self::Channel(columns) => columns.points(),
            Self::Terrain(columns) => columns.points(),
        }
    }

    /// Volume of one point [m³].
    pub fn point_volume(&self) -> f64 {
        match self {
            Self::Channel(columns) => columns.volume,
            Self::Terrain(columns) => columns.point_volume(),
        }
    }

    /// That of a channel.
    pub fn in_channel(&self) -> Option<&Columns> {
        match self {
            Self::Channel(columns) => Some(columns),
            Self::Terrain(_) => None,
        }
    }

    /// That on a terrain.
    pub fn on_terrain(&self) -> Option<&TerrainColumns> {
        match self {
            Self::Channel(_) => None,
            Self::Terrain(columns) => Some(columns),
        }
    }

    /// Points at the start, in a channel those of a share, and the volume excluded by bodies
    /// [m³].
    pub(super) fn start(
        &self,
        scenario: &Scenario,
        given: &Setup,
        bodies: &[Body],
        share: Share,
    ) -> (Vec<Point>, f64) {
        match self {
            Self::Channel(columns) => columns.release(scenario, given, bodies, share),
            Self::Terrain(columns) => columns.release_at(0.0, given, bodies),
        }
    }
}
