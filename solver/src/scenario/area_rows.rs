//! Releases on a terrain over a lattice of squares, row by row: thickness and covered share of each.

use super::polygon::{each_row_covered, squares_along};
use super::terrain::ReleasedArea;
use std::ops::Range;

/// Largest number of points of one run, and of squares that its releases may have to be looked at in.
pub(crate) const MOST_POINTS: u64 = 20_000_000;

/// Share of a square, or of a smaller cell of a map, that is rounding.
pub(super) const NOTHING: f64 = 1e-9;

/// Squares of a lattice from the south-western corner of the height map on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Window {
    /// Side of a square [m].
    pub(super) spacing: f64,
    /// Column and row of the south-western square.
    pub(crate) first: [i64; 2],
    /// Number of columns and rows.
    pub(super) count: [usize; 2],
}

/// Measure of a release in a square.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Measure {
    /// Thickness averaged over the square [m].
    Thickness,
    /// Share of the square with any thickness.
    Share,
}

impl Window {
    /// Squares of this side [m] around an area between two corners.
    pub(crate) fn around([low, high]: [[f64; 2]; 2], spacing: f64) -> Self {
        let first = low.map(|along| (along / spacing).floor() as i64);
        let last = high.map(|along| (along / spacing).ceil() as i64);
        Self {
            spacing,
            first,
            count: [0, 1].map(|axis| (last[axis] - first[axis]).max(0) as usize),
        }
    }

    /// A place [m] in squares from the south-western corner.
    pub(super) fn in_squares(&self, place: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| place[axis] / self.spacing - self.first[axis] as f64)
    }

    /// Rows from the south: the number of squares south of each, and its row in the lattice.
    pub(super) fn rows(&self) -> impl Iterator<Item = (f64, i64)> {
        let first = self.first[1];
        (0..self.count[1]).map(move |row| (row as f64, first + row as i64))
    }

    /// Number of squares.
    pub(super) fn squares(&self) -> f64 {
        self.count[0] as f64 * self.count[1] as f64
    }
}

/// Number of squares of this side [m] that releases have to be looked at in.
pub(crate) fn squares_of<'a>(
    releases: impl IntoIterator<Item = &'a ReleasedArea<'a>>,
    spacing: f64,
) -> f64 {
    let needed = releases.into_iter().map(|area| {
        let window = area.bounds().map(|bounds| Window::around(bounds, spacing));
        let along = match area {
            ReleasedArea::Polygon { corners, .. } => squares_along(corners, spacing),
            _ => 0.0,
        };
        window.map_or(0.0, |window| window.squares()) + along
    });
    needed.sum()
}

impl ReleasedArea<'_> {
    /// Calls with a measure of the release in each square of a row, row by row from the south.
    pub(crate) fn each_row(
        &self,
        window: &Window,
        measure: Measure,
        mut of_row: impl FnMut(i64, &[f64]),
    ) {
        let Self::Polygon { corners, thickness } = self else {
            return self.each_row_of_map(window, measure, of_row);
        };
        each_row_covered(corners, window, |row, shares| {
            if measure == Measure::Thickness {
                shares.iter_mut().for_each(|share| *share *= thickness);
            }
            of_row(row, shares);
        });
    }

    /// Calls with the cells of a map spread over the squares that they overlap.
    fn each_row_of_map(
        &self,
        window: &Window,
        measure: Measure,
        mut of_row: impl FnMut(i64, &[f64]),
    ) {
        let Some((map, origin)) = self.map() else {
            return;
        };
        let corner = window.in_squares([map.west - origin[0], map.south - origin[1]]);
        let side = map.cell_size / window.spacing;
        let eastwards = Cells {
            from: corner[0],
            side,
            count: map.columns,
        };
        let northwards = Cells {
            from: corner[1],
            side,
            count: map.rows,
        };
        let columns = eastwards.over(0.0, window.count[0] as f64);
        let mut squares = vec![0.0; window.count[0]];
        for (south, row) in window.rows() {
            squares.fill(0.0);
            for map_row in northwards.over(south, south + 1.0) {
                let height = northwards.overlap(map_row, south);
                for column in columns.clone() {
                    let thickness = self.thickness_of(map.centre(column, map_row));
                    match measure {
                        Measure::Thickness => {
                            eastwards.spread(column, height * thickness, &mut squares);
                        }
                        Measure::Share if thickness > 0.0 => {
                            eastwards.spread(column, height, &mut squares);
                        }
                        Measure::Share => (),
                    }
                }
            }
            of_row(row, &squares);
        }
    }
}

/// Cells of a map along an axis, in squares.
struct Cells {
    /// Beginning of the first.
    from: f64,
    /// Side of each.
    side: f64,
    count: usize,
}

impl Cells {
    /// Cells that overlap a range.
    fn over(&self, low: f64, high: f64) -> Range<usize> {
        let low = ((low - self.from) / self.side).floor().max(0.0) as usize;
        let high = ((high - self.from) / self.side).ceil().max(0.0) as usize;
        low..high.min(self.count)
    }

    /// Share of the square that begins here which a cell overlaps; 0 if it is rounding.
    fn overlap(&self, cell: usize, square: f64) -> f64 {
        let west = self.from + cell as f64 * self.side;
        let overlap = (west + self.side).min(square + 1.0) - west.max(square);
        if overlap > NOTHING * self.side.min(1.0) {
            overlap
        } else {
            0.0
        }
    }

    /// Adds a value to the squares that a cell overlaps, by the shares that it overlaps.
    fn spread(&self, cell: usize, value: f64, squares: &mut [f64]) {
        if value == 0.0 {
            return;
        }
        let west = self.from + cell as f64 * self.side;
        let last = ((west + self.side).ceil().max(0.0) as usize).min(squares.len());
        let first = (west.max(0.0) as usize).min(last);
        for (square, sum) in squares[first..last].iter_mut().enumerate() {
            *sum += value * self.overlap(cell, (first + square) as f64);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::Raster;

    /// Measures of a release, row by row.
    fn rows(area: &ReleasedArea<'_>, window: &Window, measure: Measure) -> Vec<Vec<f64>> {
        let mut rows = Vec::new();
        area.each_row(window, measure, |_, squares| rows.push(squares.to_vec()));
        rows
    }

    fn map(cell_size: f64, values: [f64; 4]) -> Raster {
        Raster {
            columns: 2,
            rows: 2,
            cell_size,
            west: 10.0,
            south: 20.0,
            epsg: None,
            values: values.to_vec(),
        }
    }

    #[test]
    fn cells_of_a_map_are_spread_by_their_overlap() {
        let (ground, thickness) = (map(2.0, [0.0; 4]), map(1.5, [1.0, 2.0, f64::NAN, 4.0]));
        let area = ReleasedArea::Thickness {
            map: &thickness,
            ground: &ground,
        };
        let window = Window::around([[0.0, 0.0], [3.0, 3.0]], 1.0);
        let found = rows(&area, &window, Measure::Thickness);
        let expected = [[1.0, 1.5, 2.0], [0.5, 1.75, 3.0], [0.0, 2.0, 4.0]];
        assert_eq!(found, expected);
        let found = rows(&area, &window, Measure::Share);
        assert_eq!(found[1], [0.5, 0.75, 1.0]);
        // All of a fine spot is in the square around it.
        let window = Window::around([[0.0, 0.0], [3.0, 3.0]], 50.0);
        let found = rows(&area, &window, Measure::Thickness);
        assert!((found[0][0] * 2500.0 - area.volume()).abs() < 1e-12);
    }

    #[test]
    fn a_small_window_is_cut_out_of_a_map() {
        let (ground, thickness) = (map(2.0, [0.0; 4]), map(1.5, [1.0, 2.0, f64::NAN, 4.0]));
        let area = ReleasedArea::Thickness {
            map: &thickness,
            ground: &ground,
        };
        let window = Window::around([[1.0, 1.0], [2.0, 2.0]], 1.0);
        assert_eq!(rows(&area, &window, Measure::Thickness), [[1.75]]);
    }

    #[test]
    fn squares_of_releases_are_counted_before_any_work() {
        let area = ReleasedArea::Polygon {
            corners: vec![[1.0, 1.0], [59.0, 1.0], [59.0, 59.0], [1.0, 59.0]],
            thickness: 1e-6,
        };
        assert_eq!(squares_of([&area], 1.0), 58.0 * 58.0 + 4.0 * 59.0);
        assert!(squares_of([&area, &area], 0.005) > 2.0 * 1.3e8);
    }
}
