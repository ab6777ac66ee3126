//! Terrain of a scenario: its maps, its releases, and the ground that they make.

use super::maps::Maps;
use super::{Scenario, Source};
use crate::bed::{HeightField, TerrainFriction};
use crate::math::Vec3;
use crate::raster::Raster;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A terrain: a height map instead of a channel. In the computation x runs east and y north from
/// the south-western corner of the map, and z up from a whole number of metres below its lowest
/// place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Terrain {
    /// Height map: the SHA-256 of its file in 64 hexadecimal digits.
    pub height_map: String,
    /// Coordinates of places in the scenario.
    pub coordinates: Coordinates,
    /// Coulomb friction between flow and ground, where no map of it is given.
    pub base_friction: f64,
    /// Map of that friction: the SHA-256 of its file; `null`: it is the same everywhere.
    pub base_friction_map: Option<String>,
    /// The maps that the scenario names, once they are there.
    #[serde(skip)]
    pub maps: Maps,
}

/// Coordinates in which places on a terrain are given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Coordinates {
    /// Those of the height map: easting, northing and elevation in its reference system.
    #[default]
    Map,
    /// From the south-western corner of the map, and from the datum of the run.
    Local,
}

/// A release on a terrain: an area by a polygon, or by a map.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct TerrainRelease {
    /// Corners of the area, easting and northing in the terrain's coordinates [m]; `null`: a map
    /// gives it.
    pub polygon_m: Option<Vec<[f64; 2]>>,
    /// Vertical thickness within the polygon [m].
    pub thickness_m: Option<f64>,
    /// Map of the vertical thickness: the SHA-256 of its file.
    pub thickness_map: Option<String>,
    /// Map of the surface with the release still in place: the SHA-256 of its file. What lies above
    /// the height map is released.
    pub surface_map: Option<String>,
    /// Time of the release [s].
    pub time_s: f64,
}

/// A release in local coordinates: its thickness at every place.
#[derive(Debug, Clone)]
pub(crate) enum ReleasedArea<'a> {
    /// The same thickness within a polygon.
    Polygon {
        /// Corners [m].
        corners: Vec<[f64; 2]>,
        /// Vertical thickness [m].
        thickness: f64,
    },
    /// The thickness of a map.
    Thickness {
        /// The map, in the height map's coordinates.
        map: &'a Raster,
        /// The height map.
        ground: &'a Raster,
    },
    /// The difference of a surface and the height map.
    Surface {
        /// The surface, in the height map's coordinates.
        map: &'a Raster,
        /// The height map.
        ground: &'a Raster,
    },
}

impl Terrain {
    /// The height map.
    ///
    /// # Panics
    /// If the scenario was read without its maps.
    pub fn height(&self) -> &Arc<Raster> {
        self.map(&self.height_map)
    }

    fn map(&self, name: &str) -> &Arc<Raster> {
        self.maps
            .get(name)
            .expect("a scenario is read with its maps")
    }

    /// Easting, northing and elevation of the origin of local coordinates [m].
    pub fn origin(&self) -> Vec3 {
        let height = self.height();
        Vec3::new(height.west, height.south, self.maps.datum(&self.height_map))
    }

    /// Easting and northing in local coordinates [m].
    pub fn to_local(&self, place: [f64; 2]) -> [f64; 2] {
        match self.coordinates {
            Coordinates::Local => place,
            Coordinates::Map => {
                let origin = self.origin();
                [place[0] - origin.x, place[1] - origin.y]
            }
        }
    }

    /// Elevation in local coordinates [m].
    pub fn to_local_elevation(&self, elevation: f64) -> f64 {
        match self.coordinates {
            Coordinates::Local => elevation,
            Coordinates::Map => elevation - self.origin().z,
        }
    }

    /// Extent to the east and to the north [m].
    pub fn extent(&self) -> [f64; 2] {
        let height = self.height();
        [height.east() - height.west, height.north() - height.south]
    }

    /// The ground for cells of this size [m]: a height map with finer cells is averaged to about
    /// theirs.
    pub fn ground(&self, cell_size: f64) -> HeightField {
        let surface = self.maps.surface(&self.height_map, cell_size);
        let friction = match &self.base_friction_map {
            None => TerrainFriction::Constant(self.base_friction),
            Some(name) => TerrainFriction::PerCell {
                map: Arc::clone(self.map(name)),
                origin: [self.height().west, self.height().south],
            },
        };
        HeightField::new(surface, friction)
    }

    /// A release in local coordinates.
    pub(crate) fn area<'a>(&'a self, release: &'a TerrainRelease) -> ReleasedArea<'a> {
        let height = self.height();
        match (
            &release.polygon_m,
            &release.thickness_map,
            &release.surface_map,
        ) {
            (Some(corners), ..) => ReleasedArea::Polygon {
                corners: corners
                    .iter()
                    .map(|corner| self.to_local(*corner))
                    .collect(),
                thickness: release.thickness_m.unwrap_or(0.0),
            },
            (None, Some(name), _) => ReleasedArea::Thickness {
                map: self.map(name),
                ground: height,
            },
            (None, None, Some(name)) => ReleasedArea::Surface {
                map: self.map(name),
                ground: height,
            },
            (None, None, None) => ReleasedArea::Polygon {
                corners: Vec::new(),
                thickness: 0.0,
            },
        }
    }
}

impl Scenario {
    /// The releases on its terrain, in local coordinates.
    pub(crate) fn terrain_releases(&self) -> impl Iterator<Item = ReleasedArea<'_>> {
        let releases = match (self.terrain(), self.flow.as_ref().map(|flow| &flow.source)) {
            (Some(terrain), Some(Source::Terrain { releases })) => Some((terrain, releases)),
            _ => None,
        };
        releases
            .into_iter()
            .flat_map(|(terrain, releases)| releases.iter().map(|one| terrain.area(one)))
    }
}
