//! Coefficients of a surface through a raster (docs/method.md, equation 80).

use crate::raster::Raster;
use rayon::prelude::*;

/// Farthest that a coefficient is beyond the values of its cell and the neighbours, over the side of a
/// cell: as much as a break of slope of 58° needs.
const BEYOND: f64 = 0.1;

/// Change of slope between two pairs of cells beyond which it is a cliff, on which no coefficient
/// beside it depends.
const CLIFF: f64 = 2.0;
/// Columns that are turned into coefficients beside each other.
const BESIDE: usize = 64;

/// Coefficients row by row, with one more at each end of each row and column [m]: those of the values
/// less a datum [m], limited at cliffs.
pub(super) fn coefficients(raster: &Raster, datum: f64) -> Vec<f64> {
    let (columns, rows) = (raster.columns, raster.rows);
    let width = columns + 2;
    let mut coefficients = vec![0.0; width * (rows + 2)];
    coefficients[width..width * (rows + 1)]
        .par_chunks_mut(width)
        .zip(raster.values.par_chunks(columns))
        .for_each(|(row, values)| {
            for (coefficient, value) in row[1..].iter_mut().zip(values) {
                *coefficient = value - datum;
            }
            interpolate_row(row, values, raster.cell_size);
        });
    interpolate_columns(&mut coefficients, raster);
    limit(&mut coefficients, raster, datum);
    coefficients
}

/// Limits each coefficient of a cell to the values there and of the neighbours, with some room; those
/// beyond the edges go on evenly.
fn limit(coefficients: &mut [f64], raster: &Raster, datum: f64) {
    let width = raster.columns + 2;
    let room = BEYOND * raster.cell_size;
    let inner = &mut coefficients[width..width * (raster.rows + 1)];
    let rows = inner.par_chunks_mut(width).enumerate();
    rows.for_each(|(row, coefficients)| {
        for column in 0..raster.columns {
            let [lowest, highest] = range_round(raster, [column, row]);
            let coefficient = &mut coefficients[column + 1];
            *coefficient = coefficient.clamp(lowest - datum - room, highest - datum + room);
        }
        go_on_evenly(coefficients);
    });
    go_on_evenly_up(coefficients, width);
}

/// Lowest and highest value of a cell and the cells round it.
fn range_round(raster: &Raster, [column, row]: [usize; 2]) -> [f64; 2] {
    let near = |at: usize, count: usize| at.saturating_sub(1)..(at + 2).min(count);
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for row in near(row, raster.rows) {
        for column in near(column, raster.columns) {
            let value = raster.value_at(column, row);
            range = [range[0].min(value), range[1].max(value)];
        }
    }
    range
}

/// Sets the first and the last entry of a row by its slope there.
fn go_on_evenly(row: &mut [f64]) {
    let count = row.len() - 2;
    row[0] = 2.0 * row[1] - row[2];
    row[count + 1] = 2.0 * row[count] - row[count - 1];
}

/// Sets the first and the last row by the slope there.
fn go_on_evenly_up(rows: &mut [f64], width: usize) {
    let count = rows.len() / width - 2;
    for i in 0..width {
        let at = |n: usize| n * width + i;
        rows[at(0)] = 2.0 * rows[at(1)] - rows[at(2)];
        rows[at(count + 1)] = 2.0 * rows[at(count)] - rows[at(count - 1)];
    }
}

/// True if a slope changes so much between these values [m] in a row that it is a cliff, on cells of
/// this side [m].
fn is_cliff([before, here, after]: [f64; 3], cell: f64) -> bool {
    (before - 2.0 * here + after).abs() > CLIFF * cell
}

/// One step of the elimination for a line of coefficients: c₋ + 6 c + c₊ = 8 × value, but c = value at
/// a `cliff`. Takes and gives the factor of the next coefficient, and the value.
///
/// The first and the last coefficient of a line are the values there, since beyond both ends the
/// coefficients go on evenly.
fn eliminate(cliff: bool, [factor_before, before]: [f64; 2], value: f64) -> [f64; 2] {
    if cliff {
        return [0.0, value];
    }
    let factor = 1.0 / (6.0 - factor_before);
    [factor, (8.0 * value - before) * factor]
}

/// Turns a row of values into coefficients, from its second entry on.
fn interpolate_row(row: &mut [f64], values: &[f64], cell: f64) {
    let count = values.len();
    let mut factors = vec![0.0; count + 1];
    for n in 2..count {
        let cliff = is_cliff([values[n - 2], values[n - 1], values[n]], cell);
        [factors[n], row[n]] = eliminate(cliff, [factors[n - 1], row[n - 1]], row[n]);
    }
    for n in (2..count).rev() {
        row[n] -= factors[n] * row[n + 1];
    }
    go_on_evenly(row);
}

/// Turns all columns of a raster into coefficients, of which the rows are already.
fn interpolate_columns(rows: &mut [f64], raster: &Raster) {
    let (width, count) = (raster.columns + 2, raster.rows);
    let mut factors = vec![[0.0; BESIDE]; count + 1];
    for start in (0..raster.columns).step_by(BESIDE) {
        let columns = start..(start + BESIDE).min(raster.columns);
        let at = |n: usize, column: usize| n * width + column + 1;
        for n in 2..count {
            for column in columns.clone() {
                let values = [n - 2, n - 1, n].map(|row| raster.value_at(column, row));
                let cliff = is_cliff(values, raster.cell_size);
                let before = [factors[n - 1][column - start], rows[at(n - 1, column)]];
                let here = &mut rows[at(n, column)];
                [factors[n][column - start], *here] = eliminate(cliff, before, *here);
            }
        }
        for n in (2..count).rev() {
            for column in columns.clone() {
                let after = rows[at(n + 1, column)];
                rows[at(n, column)] -= factors[n][column - start] * after;
            }
        }
    }
}
