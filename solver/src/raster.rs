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

    /// Value of the cell in which a place lies, beyond the edges that of the nearest cell.
    pub fn nearest(&self, easting: f64, northing: f64) -> f64 {
        let cell = |from: f64, count: usize| {
            let cells = (from / self.cell_size).max(0.0) as usize;
            cells.min(count - 1)
        };
        let column = cell(easting - self.west, self.columns);
        self.value_at(column, cell(northing - self.south, self.rows))
    }

    /// Value of the cell in which a place lies; NaN beyond the edges.
    pub fn at_cell(&self, easting: f64, northing: f64) -> f64 {
        let (column, row) = (
            (easting - self.west) / self.cell_size,
            (northing - self.south) / self.cell_size,
        );
        let within = |cells: f64, count: usize| cells >= 0.0 && cells < count as f64;
        if within(column, self.columns) && within(row, self.rows) {
            self.value_at(column as usize, row as usize)
        } else {
            f64::NAN
        }
    }

    /// Lowest value; infinite if there is none.
    pub fn lowest(&self) -> f64 {
        self.values.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Highest value; −infinite if there is none.
    pub fn highest(&self) -> f64 {
        self.values
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// Whole number of its cells along a length [m] that is at least one, and leaves two cells of
    /// that size each way.
    pub fn cells_within(&self, length: f64) -> usize {
        // A length of whole cells up to rounding counts as so many.
        let cells = (length / self.cell_size * (1.0 + 1e-9)) as usize;
        cells.clamp(1, (self.columns.min(self.rows) / 2).max(1))
    }

    /// The raster with so many cells along each axis averaged to one; what is left over at the
    /// north and the east is dropped.
    #[must_use]
    pub fn averaged(&self, cells: usize) -> Self {
        let (columns, rows) = (self.columns / cells, self.rows / cells);
        let mut values = Vec::with_capacity(columns * rows);
        for row in 0..rows {
            for column in 0..columns {
                let of = |n: usize| {
                    let (along, up) = (column * cells + n % cells, row * cells + n / cells);
                    self.value_at(along, up)
                };
                let sum: f64 = (0..cells * cells).map(of).sum();
                values.push(sum / (cells * cells) as f64);
            }
        }
        Self {
            columns,
            rows,
            cell_size: self.cell_size * cells as f64,
            values,
            ..*self
        }
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
