//! A smooth surface through a raster of elevations: the biquadratic B-spline that interpolates the
//! values at the centres of the cells, kept from swinging beyond them at cliffs (docs/method.md,
//! equation 80). It is continuous with its slope, and planes are reproduced exactly.

use crate::math::Vec3;
use crate::raster::Raster;
use std::ops::Range;

mod coefficients;

use coefficients::coefficients;

/// Cells beyond the edges over which the surface goes on with the slope of the edge; farther out it
/// is level in that direction.
const MARGIN: f64 = 3.0;

/// Elevation and slope of a surface at a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Facet {
    /// Elevation [m].
    pub elevation: f64,
    /// Slope ∂z/∂x and ∂z/∂y.
    pub slope: [f64; 2],
}

/// Plane above a part of a surface, as steep as its middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lid {
    /// Elevation at (0, 0) [m].
    at_origin: f64,
    /// Slope ∂z/∂x and ∂z/∂y.
    pub slope: [f64; 2],
    /// Upper bound of the size of the surface's slope under it.
    pub steepest: f64,
}

impl Lid {
    /// Elevation at (x, y) [m].
    pub fn elevation(&self, x: f64, y: f64) -> f64 {
        self.at_origin + self.slope[0] * x + self.slope[1] * y
    }

    /// Least height above it [m] of the box between these corners.
    pub fn height_of_box(&self, low: &Vec3, high: &Vec3) -> f64 {
        let highest = |axis: usize| {
            let slope = self.slope[axis];
            slope * if slope > 0.0 { high } else { low }[axis]
        };
        low.z - self.at_origin - highest(0) - highest(1)
    }

    /// Lid raised by a height [m].
    fn raised(self, by: f64) -> Self {
        Self {
            at_origin: self.at_origin + by,
            ..self
        }
    }
}

/// Biquadratic B-spline surface over a rectangle from (0, 0) on.
#[derive(Debug, Clone, PartialEq)]
pub struct SplineSurface {
    /// Side of a cell [m].
    cell: f64,
    /// Cells in a metre.
    per_metre: f64,
    /// Cells along x and y.
    cells: [usize; 2],
    /// Coefficients row by row, with one more at each end of each row and column [m].
    coefficients: Vec<f64>,
}

/// Weights of the three coefficients round a place, and of their slopes.
#[derive(Clone, Copy)]
struct Weights {
    /// Index of the first.
    first: usize,
    value: [f64; 3],
    /// Derivatives by the place [1/cell].
    slope: [f64; 3],
    /// Distance from the nearest place on the surface, up to the margin [cells].
    beyond: f64,
    /// True farther out.
    is_level: bool,
}

impl SplineSurface {
    /// The surface through these values, `datum` [m] subtracted; the raster has at least two rows
    /// and columns.
    pub fn through(raster: &Raster, datum: f64) -> Self {
        Self {
            cell: raster.cell_size,
            per_metre: 1.0 / raster.cell_size,
            cells: [raster.columns, raster.rows],
            coefficients: coefficients(raster, datum),
        }
    }

    /// Side of a cell of the raster that it runs through [m].
    pub fn cell_size(&self) -> f64 {
        self.cell
    }

    /// Extent along x and y [m].
    pub fn extent(&self) -> [f64; 2] {
        self.cells.map(|cells| cells as f64 * self.cell)
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.coefficients.capacity() * size_of::<f64>()
    }

    /// Elevation and slope at (x, y) [m].
    pub fn at(&self, x: f64, y: f64) -> Facet {
        let [along, across] = [self.weights(x, 0), self.weights(y, 1)];
        let width = self.cells[0] + 2;
        let (mut elevation, mut slope, mut twist) = (0.0, [0.0; 2], 0.0);
        for row in 0..3 {
            let start = (across.first + row) * width + along.first;
            let here: &[f64] = &self.coefficients[start..start + 3];
            let sum = |weights: &[f64; 3]| {
                weights[0] * here[0] + weights[1] * here[1] + weights[2] * here[2]
            };
            let value = sum(&along.value);
            elevation += across.value[row] * value;
            slope[0] += across.value[row] * sum(&along.slope);
            slope[1] += across.slope[row] * value;
            twist += across.slope[row] * sum(&along.slope);
        }
        let beyond = [along.beyond, across.beyond];
        if beyond == [0.0; 2] {
            let slope = slope.map(|slope| slope * self.per_metre);
            return Facet { elevation, slope };
        }
        elevation += slope[0] * beyond[0] + slope[1] * beyond[1] + twist * beyond[0] * beyond[1];
        let along_the_edge = |axis: usize| {
            let of = [&along, &across][axis];
            if of.is_level {
                0.0
            } else {
                slope[axis] + twist * beyond[1 - axis]
            }
        };
        let per_cell = [along_the_edge(0), along_the_edge(1)];
        Facet {
            elevation,
            slope: per_cell.map(|slope| slope * self.per_metre),
        }
    }

    /// Elevation at (x, y) [m], for less than elevation and slope.
    pub fn elevation(&self, x: f64, y: f64) -> f64 {
        let [along, across] = [self.weights(x, 0), self.weights(y, 1)];
        if along.beyond != 0.0 || across.beyond != 0.0 {
            return self.at(x, y).elevation;
        }
        let width = self.cells[0] + 2;
        let mut elevation = 0.0;
        for row in 0..3 {
            let start = (across.first + row) * width + along.first;
            let here: &[f64] = &self.coefficients[start..start + 3];
            let value =
                along.value[0] * here[0] + along.value[1] * here[1] + along.value[2] * here[2];
            elevation += across.value[row] * value;
        }
        elevation
    }

    /// Second derivatives ∂²z/∂x², ∂²z/∂x∂y and ∂²z/∂y² in the cell of (x, y) [1/m]; 0 beyond the
    /// edges.
    pub fn curvature(&self, x: f64, y: f64) -> [f64; 3] {
        let [along, across] = [self.weights(x, 0), self.weights(y, 1)];
        if along.beyond != 0.0 || across.beyond != 0.0 {
            return [0.0; 3];
        }
        let width = self.cells[0] + 2;
        let bent = [1.0, -2.0, 1.0];
        let sum = |of_columns: &[f64; 3], of_rows: &[f64; 3]| {
            let row = |row: usize| {
                let start = (across.first + row) * width + along.first;
                let here = &self.coefficients[start..start + 3];
                of_columns[0] * here[0] + of_columns[1] * here[1] + of_columns[2] * here[2]
            };
            of_rows[0] * row(0) + of_rows[1] * row(1) + of_rows[2] * row(2)
        };
        let square = self.cell * self.cell;
        [
            sum(&bent, &across.value),
            sum(&along.slope, &across.slope),
            sum(&along.value, &bent),
        ]
        .map(|of| of / square)
    }

    /// Upper bounds of elevation [m] and of the slope's size in a rectangle: those of the
    /// coefficients that act there.
    pub fn bounds(&self, low: [f64; 2], high: [f64; 2]) -> (f64, f64) {
        let [x, y] = [0, 1].map(|axis| self.acting(low, high, axis));
        let width = self.cells[0] + 2;
        let (mut highest, mut steepest) = (f64::NEG_INFINITY, 0.0_f64);
        for j in y.clone() {
            for i in x.clone() {
                let here = self.coefficients[j * width + i];
                highest = highest.max(here);
                if i + 1 < x.end {
                    steepest = steepest.max((self.coefficients[j * width + i + 1] - here).abs());
                }
                if j + 1 < y.end {
                    steepest = steepest.max((self.coefficients[(j + 1) * width + i] - here).abs());
                }
            }
        }
        // Beyond the edges the surface goes on with its twist.
        let beyond = self.farthest_beyond(low, high);
        let slope = steepest * std::f64::consts::SQRT_2 / self.cell * (1.0 + 2.0 * beyond);
        (highest + slope * beyond * self.cell, slope)
    }

    /// Visits the places of a rectangle between its corners [m], half a cell more on each side, where
    /// neighbouring coefficients differ by more than this slope: the middles between them.
    pub fn visit_steep(
        &self,
        [low, high]: [[f64; 2]; 2],
        slope: f64,
        mut visit: impl FnMut([f64; 2]),
    ) {
        let [x, y] = [0, 1].map(|axis| self.acting(low, high, axis));
        let (width, most) = (self.cells[0] + 2, slope * self.cell);
        let place = |i: f64, j: f64| [i - 0.5, j - 0.5].map(|along| along * self.cell);
        for j in y.clone() {
            for i in x.clone() {
                let here = self.coefficients[j * width + i];
                let (u, v) = (i as f64, j as f64);
                let differs = |other: usize| (self.coefficients[other] - here).abs() > most;
                if i + 1 < x.end && differs(j * width + i + 1) {
                    visit(place(u + 0.5, v));
                }
                if j + 1 < y.end && differs((j + 1) * width + i) {
                    visit(place(u, v + 0.5));
                }
            }
        }
    }

    /// A plane above the surface in a rectangle: on a plane that plane itself. Beyond the edges it
    /// is level.
    pub fn lid(&self, low: [f64; 2], high: [f64; 2]) -> Lid {
        let (highest, steepest) = self.bounds(low, high);
        if self.farthest_beyond(low, high) > 0.0 {
            return Lid {
                at_origin: highest,
                slope: [0.0; 2],
                steepest,
            };
        }
        let [x, y] = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]));
        let middle = self.at(x, y);
        let lid = Lid {
            at_origin: middle.elevation - middle.slope[0] * x - middle.slope[1] * y,
            slope: middle.slope,
            steepest,
        };
        lid.raised(self.farthest_above(&lid, low, high))
    }

    /// Height above a plane [m] beyond which the surface does not rise in a rectangle: that of the
    /// highest coefficient, each at the middle of its cell.
    fn farthest_above(&self, lid: &Lid, low: [f64; 2], high: [f64; 2]) -> f64 {
        let [x, y] = [0, 1].map(|axis| self.acting(low, high, axis));
        let width = self.cells[0] + 2;
        let mut farthest = f64::NEG_INFINITY;
        for j in y {
            for i in x.clone() {
                let [u, v] = [i, j].map(|along| (along as f64 - 0.5) * self.cell);
                let above = self.coefficients[j * width + i] - lid.elevation(u, v);
                farthest = farthest.max(above);
            }
        }
        farthest
    }

    /// Indices along an axis of the coefficients that act in a rectangle.
    fn acting(&self, low: [f64; 2], high: [f64; 2], axis: usize) -> Range<usize> {
        let first = |at: f64| self.weights(at, axis).first;
        first(low[axis])..first(high[axis]) + 3
    }

    /// Largest distance of a place in a rectangle from the surface, up to the margin [cells].
    fn farthest_beyond(&self, low: [f64; 2], high: [f64; 2]) -> f64 {
        let beyond = |at: f64, axis: usize| self.weights(at, axis).beyond.abs();
        let of_axis = |axis: usize| beyond(low[axis], axis).max(beyond(high[axis], axis));
        of_axis(0) + of_axis(1)
    }

    /// Curvature by which the surface bulges upwards in the cell of a place, in the direction in
    /// which it does so most [1/m]; 0 where it does nowhere. Its steepness is left apart.
    pub fn bulge(&self, x: f64, y: f64) -> f64 {
        let [i, j] = [self.weights(x, 0).first, self.weights(y, 1).first];
        let width = self.cells[0] + 2;
        let at = |a: usize, b: usize| self.coefficients[(j + b) * width + i + a];
        // A spline's second differences at the middle of the cell.
        let bent = |of: [f64; 3]| of[0] - 2.0 * of[1] + of[2];
        let mean = |of: [f64; 3]| 0.125 * of[0] + 0.75 * of[1] + 0.125 * of[2];
        let xx = mean([0, 1, 2].map(|b| bent([0, 1, 2].map(|a| at(a, b)))));
        let yy = mean([0, 1, 2].map(|a| bent([0, 1, 2].map(|b| at(a, b)))));
        let xy = 0.25 * (at(2, 2) - at(0, 2) - at(2, 0) + at(0, 0));
        let least = 0.5 * (xx + yy) - (0.5 * (xx - yy)).hypot(xy);
        (-least).max(0.0) / (self.cell * self.cell)
    }

    fn weights(&self, at: f64, axis: usize) -> Weights {
        let last = self.cells[axis] as f64;
        let cells = at * self.per_metre;
        let within = cells.clamp(0.0, last);
        let centre = (within as usize).min(self.cells[axis] - 1);
        let f = within - centre as f64 - 0.5;
        Weights {
            // The first of the row is the one before the first cell's.
            first: centre,
            value: [
                0.5 * (0.5 - f) * (0.5 - f),
                0.75 - f * f,
                0.5 * (0.5 + f) * (0.5 + f),
            ],
            slope: [f - 0.5, -2.0 * f, f + 0.5],
            beyond: (cells - within).clamp(-MARGIN, MARGIN),
            is_level: (cells - within).abs() > MARGIN,
        }
    }
}

#[cfg(test)]
mod tests;
