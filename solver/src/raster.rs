//! Rasters: numbers over a regular grid of square cells in plane coordinates.

/// A raster of numbers over a regular grid of square cells, in plane coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct Raster {
    /// Number of cells towards the east.
    pub columns: usize,
    /// Number of cells towards the north.
    pub rows: usize,
    /// Side of a cell [m].
    pub cell_size: f64,
    /// Easting of the western edge [m] in the map's coordinates.
    pub west: f64,
    /// Northing of the southern edge [m].
    pub south: f64,
    /// EPSG code of its coordinate reference system, if it is known.
    pub epsg: Option<u32>,
    /// Values row by row from the south-western cell eastwards; NaN where there is none. A value
    /// stands at the centre of its cell.
    pub values: Vec<f64>,
}

impl Raster {
    /// Place of a cell among the values; rows count from the south.
    pub fn index(&self, column: usize, row: usize) -> usize {
        debug_assert!(column < self.columns && row < self.rows);
        row * self.columns + column
    }

    /// Value of a cell; NaN where there is none.
    pub fn value_at(&self, column: usize, row: usize) -> f64 {
        self.values[self.index(column, row)]
    }

    /// Easting and northing of the centre of a cell [m].
    pub fn centre(&self, column: usize, row: usize) -> [f64; 2] {
        [
            self.west + (column as f64 + 0.5) * self.cell_size,
            self.south + (row as f64 + 0.5) * self.cell_size,
        ]
    }

    /// Easting of the eastern edge [m].
    pub fn east(&self) -> f64 {
        self.west + self.columns as f64 * self.cell_size
    }

    /// Northing of the northern edge [m].
    pub fn north(&self) -> f64 {
        self.south + self.rows as f64 * self.cell_size
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_run_eastwards_from_the_south_west() {
        let raster = Raster {
            columns: 3,
            rows: 2,
            cell_size: 2.0,
            west: 100.0,
            south: -10.0,
            epsg: None,
            values: vec![0.0, 1.0, 2.0, 10.0, 11.0, 12.0],
        };
        assert_eq!(raster.value_at(2, 0), 2.0);
        assert_eq!(raster.value_at(1, 1), 11.0);
        assert_eq!(raster.centre(2, 1), [105.0, -7.0]);
        assert_eq!([raster.east(), raster.north()], [106.0, -6.0]);
    }
}
