//! A map of the flow as a file.

use crate::results::chunk::{Block, BlockError};
use scree_rasters::{Purpose, RasterError, WriteError};
use scree_solver::raster::Raster;
use scree_solver::record::{FlowMaps, MapQuantity};
use thiserror::Error;

/// A map of the flow: the GeoTIFF in which it is stored and served.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredMap {
    /// Its quantity.
    pub quantity: MapQuantity,
    /// The file, which is packed by itself.
    pub file: Block,
}

/// Reason why a map can't be written or read.
#[derive(Debug, Error)]
pub enum MapError {
    /// It can't be written as GeoTIFF.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The file can't be read.
    #[error("a map that was written can't be read: {0}")]
    Read(#[from] RasterError),
    /// The bytes differ from those written.
    #[error(transparent)]
    Block(#[from] BlockError),
}

impl StoredMap {
    /// All maps of a run, one after the other: only one is whole in memory at a time.
    ///
    /// # Errors
    /// A map can't be written.
    pub fn all(maps: &FlowMaps) -> Result<Vec<Self>, MapError> {
        let of = |quantity| Self::of(quantity, &maps.raster(quantity));
        MapQuantity::ALL.into_iter().map(of).collect()
    }

    /// The map of a quantity.
    ///
    /// # Errors
    /// It can't be written.
    pub fn of(quantity: MapQuantity, raster: &Raster) -> Result<Self, MapError> {
        let file = Block::of_packed(scree_rasters::write_geotiff(raster)?);
        Ok(Self { quantity, file })
    }

    /// The GeoTIFF.
    ///
    /// # Errors
    /// The bytes are not those that were written.
    pub fn geotiff(self) -> Result<Vec<u8>, MapError> {
        if self.file.is_sound() {
            Ok(self.file.data)
        } else {
            Err(BlockError::Checksum.into())
        }
    }

    /// The map itself.
    ///
    /// # Errors
    /// The bytes are not those that were written.
    pub fn raster(self) -> Result<Raster, MapError> {
        Ok(scree_rasters::read(&self.geotiff()?, Purpose::Result)?)
    }

    /// The ESRI ASCII grid.
    ///
    /// # Errors
    /// The bytes are not those that were written.
    pub fn ascii(self) -> Result<String, MapError> {
        Ok(scree_rasters::write_ascii(&self.raster()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn raster() -> Raster {
        let mut values = vec![f64::NAN; 12];
        // As long as a run may last.
        (values[0], values[5], values[11]) = (0.0, 12_345.5, 0.25);
        Raster {
            columns: 4,
            rows: 3,
            cell_size: 2.5,
            west: 2_600_000.0,
            south: 1_200_000.0,
            epsg: Some(2056),
            values,
        }
    }

    #[test]
    fn a_map_comes_back_from_its_file() {
        let stored = StoredMap::of(MapQuantity::ArrivalTime, &raster()).unwrap();
        let back = stored.clone().raster().unwrap();
        assert_eq!(back.epsg, Some(2056));
        let bits = |raster: &Raster| -> Vec<u64> {
            let values = raster.values.iter();
            values.map(|value| value.to_bits()).collect()
        };
        assert_eq!(bits(&back), bits(&raster()));
        let ascii = stored.clone().ascii().unwrap();
        assert!(ascii.ends_with("0 -9999 -9999 -9999\n"), "{ascii}");
        let mut broken = stored;
        broken.file.data[20] ^= 1;
        assert!(matches!(broken.geotiff(), Err(MapError::Block(_))));
    }
}
