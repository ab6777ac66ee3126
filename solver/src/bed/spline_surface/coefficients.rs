//! Coefficients of a surface through a raster (docs/method.md, equation 80).

use crate::raster::Raster;
use rayon::prelude::*;

/// Farthest that a coefficient is beyond the values of its cell and the neighbours, over the side of a
/// cell: as much as a break of slope of 58° needs.
const BEYOND: f64 = 0.1;

/// Coefficients row by row, with one more at each end of each row and column [m]: those of the values
/// less a datum [m], limited at cliffs.
pub(super) fn coefficients(raster: &Raster, datum: f64) -> Vec<f64> {
    let (columns, rows) = (raster.columns, raster.rows);
    let width = columns + 2;
    let mut coefficients = vec![0.0; width * (rows + 2)];
    let factors = factors(columns);
    coefficients[width..width * (rows + 1)]
        .par_chunks_mut(width)
        .zip(raster.values.par_chunks(columns))
        .for_each(|(row, values)| {
            for (coefficient, value) in row[1..].iter_mut().zip(values) {
                *coefficient = value - datum;
            }
            interpolate_row(row, &factors);
        });
    interpolate_columns(&mut coefficients, width);
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

/// Factors of the elimination for a line of so many coefficients: c₋ + 6 c + c₊ = 8 × value.
/// The first and the last coefficient are the values there, since beyond both ends the
/// coefficients go on evenly.
fn factors(count: usize) -> Vec<f64> {
    let mut factors = vec![0.0; count + 1];
    for n in 2..count {
        factors[n] = 1.0 / (6.0 - factors[n - 1]);
    }
    factors
}

/// Turns the values of a row, from its second entry on, into coefficients.
fn interpolate_row(row: &mut [f64], factors: &[f64]) {
    let count = row.len() - 2;
    for n in 2..count {
        row[n] = (8.0 * row[n] - row[n - 1]) * factors[n];
    }
    for n in (2..count).rev() {
        row[n] -= factors[n] * row[n + 1];
    }
    go_on_evenly(row);
}

/// Turns the values of all columns, from their second entries on, into coefficients.
fn interpolate_columns(rows: &mut [f64], width: usize) {
    let count = rows.len() / width - 2;
    let factors = factors(count);
    for n in 2..count {
        let (before, here) = rows.split_at_mut(n * width);
        let before = &before[(n - 1) * width..];
        for (value, before) in here[..width].iter_mut().zip(before) {
            *value = (8.0 * *value - *before) * factors[n];
        }
    }
    for n in (2..count).rev() {
        let (here, after) = rows.split_at_mut((n + 1) * width);
        for (value, after) in here[n * width..].iter_mut().zip(after) {
            *value -= factors[n] * *after;
        }
    }
    go_on_evenly_up(rows, width);
}
