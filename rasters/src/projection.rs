//! Places on a map as longitude and latitude.

use proj4rs::Proj;
use proj4rs::errors::Error as ProjError;
use proj4rs::transform::transform;
use thiserror::Error;

/// WGS 84 in angles.
const WGS_84: &str = "+proj=longlat +datum=WGS84 +no_defs";

/// A coordinate reference system or place that can't be transformed.
#[derive(Debug, Error)]
pub enum ProjectionError {
    /// A code that is not in the table.
    #[error("EPSG:{epsg} is not a known coordinate reference system")]
    Unknown {
        /// EPSG code.
        epsg: u32,
    },
    /// A projection that the library doesn't have, or a grid of datum shifts.
    #[error("EPSG:{epsg} can't be transformed to longitude and latitude: {source}")]
    Unsupported {
        /// EPSG code.
        epsg: u32,
        /// What is missing.
        source: ProjError,
    },
    /// Angles or coordinates from the Earth's centre.
    #[error("EPSG:{epsg} has no plane coordinates; give a projected coordinate system")]
    NoPlane {
        /// EPSG code.
        epsg: u32,
    },
    /// A place beyond the projection.
    #[error("easting {easting} m and northing {northing} m are no place of EPSG:{epsg}")]
    NoPlace {
        /// EPSG code.
        epsg: u32,
        /// Easting [m].
        easting: f64,
        /// Northing [m].
        northing: f64,
    },
}

/// Projection of a coordinate reference system: its plane coordinates as longitude and latitude
/// in WGS 84.
///
/// Within a zone, results are those of PROJ to a millimetre where the datum is WGS 84 or an
/// ETRS89 that is taken as equal to it (the two differ by less than 1 m). Other datums are
/// shifted by the seven parameters or fewer that the code's definition has, without grids: that
/// is good to about 1 m for LV95 (EPSG:2056), but only to some metres for DHDN, OSGB36 or NAD27,
/// and a definition that needs a grid is refused.
#[derive(Debug)]
pub struct Projection {
    epsg: u32,
    plane: Proj,
    wgs_84: Proj,
}

impl Projection {
    /// Projection of an EPSG code.
    ///
    /// # Errors
    /// The code is not known, is no projected coordinate system or can't be transformed.
    pub fn of(epsg: u32) -> Result<Self, ProjectionError> {
        let definition = definition(epsg).ok_or(ProjectionError::Unknown { epsg })?;
        let unsupported = |source| ProjectionError::Unsupported { epsg, source };
        let plane = Proj::from_proj_string(definition).map_err(unsupported)?;
        if !is_plane(&plane) {
            return Err(ProjectionError::NoPlane { epsg });
        }
        let wgs_84 = Proj::from_proj_string(WGS_84).map_err(unsupported)?;
        Ok(Self {
            epsg,
            plane,
            wgs_84,
        })
    }

    /// Longitude and latitude [°] of a place [m].
    ///
    /// # Errors
    /// The place is beyond the projection.
    pub fn longitude_latitude(
        &self,
        easting: f64,
        northing: f64,
    ) -> Result<[f64; 2], ProjectionError> {
        let mut place = (easting, northing, 0.0);
        let transformed = transform(&self.plane, &self.wgs_84, &mut place);
        let angles = [place.0.to_degrees(), place.1.to_degrees()];
        match transformed {
            Ok(()) if angles.iter().all(|angle| angle.is_finite()) => Ok(angles),
            _ => Err(ProjectionError::NoPlace {
                epsg: self.epsg,
                easting,
                northing,
            }),
        }
    }
}

/// A coordinate reference system in angles or in space.
#[derive(Debug)]
pub(crate) struct NoPlane;

/// Length of a unit of a coordinate reference system [m], if it is known.
pub(crate) fn metres_of_unit(epsg: u32) -> Option<Result<f64, NoPlane>> {
    let proj = Proj::from_proj_string(definition(epsg)?).ok()?;
    let metres = is_plane(&proj).then(|| proj.to_meter());
    Some(metres.ok_or(NoPlane))
}

fn is_plane(proj: &Proj) -> bool {
    !proj.is_latlong() && !proj.is_geocent()
}

/// Definition of a code in the notation of PROJ.
fn definition(epsg: u32) -> Option<&'static str> {
    let code = u16::try_from(epsg).ok()?;
    Some(crs_definitions::from_code(code)?.proj4)
}
