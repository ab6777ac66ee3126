//! Coordinates of features.

use scree_rasters::{Projection, ProjectionError};
use thiserror::Error;

/// Coordinates in which features are written.
#[derive(Debug)]
pub enum Coordinates {
    /// Longitude and latitude in WGS 84, as RFC 7946 asks for.
    Wgs84(Box<Projection>),
    /// Easting and northing of the height map, in a reference system that may be known.
    Map(Option<u32>),
}

/// Reason why places have no longitudes and latitudes.
#[derive(Debug, Error)]
pub enum NoCoordinates {
    /// The height map does not say its reference system.
    #[error(
        "the height map does not name its coordinate reference system, so places on it have no \
         longitudes and latitudes; ask for the map's own coordinates"
    )]
    Unknown,
    /// The reference system can't be transformed, or a place in it.
    #[error(transparent)]
    Projection(#[from] ProjectionError),
}

impl Coordinates {
    /// Longitude and latitude of a map in this reference system.
    ///
    /// # Errors
    /// It is not known, or can't be transformed.
    pub fn wgs_84(epsg: Option<u32>) -> Result<Self, NoCoordinates> {
        let epsg = epsg.ok_or(NoCoordinates::Unknown)?;
        Ok(Self::Wgs84(Box::new(Projection::of(epsg)?)))
    }

    /// The position of a place on the map [m]: to a millimetre, or 1e-8°, which is about that.
    ///
    /// # Errors
    /// The place is beyond the projection.
    pub(super) fn position(
        &self,
        [easting, northing]: [f64; 2],
    ) -> Result<Vec<f64>, NoCoordinates> {
        let rounded = |value: f64, parts: f64| (value * parts).round() / parts;
        Ok(match self {
            Self::Map(_) => vec![rounded(easting, 1e3), rounded(northing, 1e3)],
            Self::Wgs84(projection) => {
                let angles = projection.longitude_latitude(easting, northing)?;
                angles.map(|angle| rounded(angle, 1e8)).to_vec()
            }
        })
    }
}
