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
    /// A raster from (0, 0) on, with so many columns and rows, of a value at every place (x, y) [m].
    pub fn sampled(
        [columns, rows]: [usize; 2],
        cell_size: f64,
        value: impl Fn(f64, f64) -> f64,
    ) -> Self {
        let mut raster = Self {
            columns,
            rows,
            cell_size,
            west: 0.0,
            south: 0.0,
            epsg: None,
            values: Vec::with_capacity(columns * rows),
        };
        for row in 0..rows {
            for column in 0..columns {
                let [x, y] = raster.centre(column, row);
                raster.values.push(value(x, y));
            }
        }
        raster
    }

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

    /// The raster with so many cells along each axis averaged to one. The last cells to the east and
    /// to the north may reach beyond the map: they go on with the slope there.
    #[must_use]
    pub fn averaged(&self, cells: usize) -> Self {
        let rows = self.values.chunks(self.columns);
        let rows: Vec<Vec<f64>> = rows.map(|row| averaged_line(row, cells)).collect();
        let columns = self.columns.div_ceil(cells);
        let of_columns: Vec<Vec<f64>> = (0..columns)
            .map(|column| {
                let line: Vec<f64> = rows.iter().map(|row| row[column]).collect();
                averaged_line(&line, cells)
            })
            .collect();
        let rows = self.rows.div_ceil(cells);
        let values = (0..rows).flat_map(|row| of_columns.iter().map(move |column| column[row]));
        Self {
            columns,
            rows,
            cell_size: self.cell_size * cells as f64,
            values: values.collect(),
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

/// Means of so many values after one another; one of fewer at the end is moved to where that of as
/// many would be, with the slope there.
fn averaged_line(line: &[f64], cells: usize) -> Vec<f64> {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let mut means: Vec<f64> = line.chunks(cells).map(mean).collect();
    let rest = line.len() % cells;
    if let ([.., before, last], true) = (means.as_mut_slice(), rest > 0) {
        let distance = 0.5 * (cells + rest) as f64;
        *last = *before + (*last - *before) * cells as f64 / distance;
    }
    means
}

#[cfg(test)]
mod tests {
    use super::*;

    // Also where the last cells are larger than what is left of the map.
    #[test]
    fn an_averaged_plane_is_the_plane() {
        let plane = |x: f64, y: f64| 5.0 + 0.4 * x - 0.3 * y;
        let raster = Raster::sampled([11, 8], 2.0, plane);
        let averaged = raster.averaged(3);
        assert_eq!([averaged.columns, averaged.rows], [4, 3]);
        assert!(averaged.east() >= raster.east() && averaged.north() >= raster.north());
        for row in 0..3 {
            for column in 0..4 {
                let [x, y] = averaged.centre(column, row);
                let off = averaged.value_at(column, row) - plane(x, y);
                assert!(off.abs() < 1e-12, "{column} {row}: {off}");
            }
        }
    }

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
