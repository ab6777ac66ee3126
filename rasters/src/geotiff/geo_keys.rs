//! `GeoKeyDirectory`: what the coordinates mean (OGC 19-008r4, annex B).

use super::{GeoTiffError, Tiff, doubles};
use crate::projection;
use std::ops::RangeInclusive;
use tiff::tags::Tag;

const MODEL_TYPE: u16 = 1024;
const RASTER_TYPE: u16 = 1025;
const GEODETIC_CRS: u16 = 2048;
const PROJECTED_CRS: u16 = 3072;
const LINEAR_UNITS: u16 = 3076;
const LINEAR_UNIT_SIZE: u16 = 3077;
const VERTICAL_CRS: u16 = 4096;
const VERTICAL_UNITS: u16 = 4099;

/// Place of a key's value: the tag of double numbers.
const DOUBLES: u16 = 34736;

/// Model types that are no plane map.
const GEOGRAPHIC: u16 = 2;
const GEOCENTRIC: u16 = 3;
/// A tie point is the centre of its cell.
const PIXEL_IS_POINT: u16 = 2;
/// Unit code of the metre.
const METRE: u16 = 9001;
/// Vertical coordinate reference systems of EPSG in feet of some kind. GDAL gives no unit with
/// them.
const IN_FEET: [u32; 15] = [
    5614, 5702, 5754, 6130, 6131, 6132, 6358, 6359, 6360, 8050, 8051, 8052, 8053, 8228, 8897,
];
/// Codes of EPSG; beyond are private ones, and 32767 for what further keys define.
pub(super) const EPSG: RangeInclusive<u16> = 1024..=32766;
const UNDEFINED: u16 = 0;

/// Keys with a short number as their value, and the size of the unit of length.
pub(super) struct GeoKeys {
    shorts: Vec<[u16; 2]>,
    /// Length of the unit of the coordinates, if it is given [m].
    unit_size: Option<f64>,
}

impl GeoKeys {
    pub(super) fn of(tiff: &mut Tiff<'_>) -> Result<Self, GeoTiffError> {
        let directory = tiff.find_tag_unsigned_vec::<u16>(Tag::GeoKeyDirectoryTag)?;
        let directory = directory.unwrap_or_default();
        // A version and the number of keys, then keys: id, place (0: here), count and value.
        let mut entries = directory.chunks_exact(4);
        let count = entries.next().map_or(0, |head| usize::from(head[3]));
        let (mut shorts, mut size) = (Vec::new(), None);
        for entry in entries.take(count) {
            match (entry[0], entry[1]) {
                (key, 0) => shorts.push([key, entry[3]]),
                (LINEAR_UNIT_SIZE, DOUBLES) => size = Some(usize::from(entry[3])),
                _ => {}
            }
        }
        let numbers = doubles(tiff, Tag::GeoDoubleParamsTag)?.unwrap_or_default();
        Ok(Self {
            shorts,
            unit_size: size.and_then(|place| numbers.get(place).copied()),
        })
    }

    /// Value of a key, if it is given and defined.
    fn get(&self, key: u16) -> Option<u16> {
        let entry = self.shorts.iter().find(|[id, _]| *id == key)?;
        (entry[1] != UNDEFINED).then_some(entry[1])
    }

    pub(super) fn is_point(&self) -> bool {
        self.get(RASTER_TYPE) == Some(PIXEL_IS_POINT)
    }

    /// Code of a projected coordinate system in metres, if it has one.
    pub(super) fn epsg(&self) -> Result<Option<u32>, GeoTiffError> {
        let epsg = self.get(PROJECTED_CRS);
        let epsg = epsg.filter(|code| EPSG.contains(code)).map(u32::from);
        match self.get(MODEL_TYPE) {
            Some(GEOGRAPHIC) => return Err(GeoTiffError::Geographic),
            Some(GEOCENTRIC) => return Err(GeoTiffError::Geocentric),
            None if epsg.is_none() && self.get(GEODETIC_CRS).is_some() => {
                return Err(GeoTiffError::Geographic);
            }
            _ => {}
        }
        self.require_metres()?;
        if let Some(epsg) = epsg {
            require_plane_metres(epsg)?;
        }
        Ok(epsg)
    }

    fn require_metres(&self) -> Result<(), GeoTiffError> {
        let other = |key| self.get(key).filter(|code| *code != METRE);
        if let Some(code) = other(LINEAR_UNITS) {
            let name = unit(code);
            return Err(GeoTiffError::LinearUnit { code, name });
        }
        if let Some(metres) = self.unit_size.filter(|metres| *metres != 1.0) {
            return Err(GeoTiffError::LinearUnitSize { metres });
        }
        if let Some(code) = other(VERTICAL_UNITS) {
            let name = unit(code);
            return Err(GeoTiffError::VerticalUnit { code, name });
        }
        match self.get(VERTICAL_CRS).map(u32::from) {
            Some(epsg) if IN_FEET.contains(&epsg) => Err(GeoTiffError::VerticalCrs { epsg }),
            _ => Ok(()),
        }
    }
}

/// Refuses a code that is known and whose coordinates aren't metres in a plane.
fn require_plane_metres(epsg: u32) -> Result<(), GeoTiffError> {
    match projection::metres_of_unit(epsg) {
        Some(Ok(1.0)) | None => Ok(()),
        Some(Ok(metres)) => Err(GeoTiffError::CrsUnit { epsg, metres }),
        Some(Err(projection::NoPlane)) => Err(GeoTiffError::Geographic),
    }
}

/// Name of a unit of length.
fn unit(code: u16) -> &'static str {
    match code {
        9002 => "feet",
        9003 => "US survey feet",
        9036 => "kilometres",
        _ => "another unit",
    }
}
