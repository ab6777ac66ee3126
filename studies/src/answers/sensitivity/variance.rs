//! Variance-based indices of a Saltelli design.

use crate::answers::Estimate;
use crate::design::Saltelli;
use crate::moments;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Sobol' indices of a quantity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct SobolIndices {
    /// Indices of the inputs, in their order.
    pub inputs: Vec<SobolIndex>,
    /// Rows of the design of which every member has the quantity.
    pub rows: u64,
    /// Rows left out because a member lacks it.
    pub rows_left_out: u64,
}

/// Sobol' indices of one input.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct SobolIndex {
    /// Share of the variance that the input explains alone (Saltelli et al. 2010, table 2, b).
    pub first_order: Estimate,
    /// Share of the variance that the input has a part in (Jansen 1999).
    pub total: Estimate,
}

/// Quantity of the members of a row: A, B, AB_0, AB_1, …
type Row = Vec<f64>;

impl SobolIndices {
    /// Indices from the known members; none if the quantity does not vary.
    pub(super) fn of(design: &Saltelli, inputs: usize, known: &BTreeMap<u64, f64>) -> Option<Self> {
        let members = inputs as u64 + 2;
        let row = |number: u64| -> Option<Row> {
            let indices = number * members..(number + 1) * members;
            indices.map(|index| known.get(&index).copied()).collect()
        };
        let rows: Vec<Row> = (0..design.base_members).filter_map(row).collect();
        let all: Vec<usize> = (0..rows.len()).collect();
        (variance(&rows, &all) > 0.0).then(|| Self {
            inputs: (0..inputs)
                .map(|input| SobolIndex::of(&rows, input))
                .collect(),
            rows: rows.len() as u64,
            rows_left_out: design.base_members - rows.len() as u64,
        })
    }
}

impl SobolIndex {
    fn of(rows: &[Row], input: usize) -> Self {
        Self {
            first_order: Estimate::percentile(rows.len(), &|drawn| first_order(rows, drawn, input)),
            total: Estimate::percentile(rows.len(), &|drawn| total(rows, drawn, input)),
        }
    }
}

/// First-order index: mean of f_B (f_AB − f_A) over the variance. The mean of f is taken off f_B
/// first, which changes no expectation and lessens the noise.
fn first_order(rows: &[Row], drawn: &[usize], input: usize) -> f64 {
    let mean = moments::mean(&base(rows, drawn));
    let product = |row: &usize| {
        let row = &rows[*row];
        (row[1] - mean) * (row[input + 2] - row[0])
    };
    over_variance(drawn.iter().map(product).sum(), rows, drawn)
}

/// Total index: half the mean of (f_A − f_AB)² over the variance.
fn total(rows: &[Row], drawn: &[usize], input: usize) -> f64 {
    let square = |row: &usize| {
        let change = rows[*row][0] - rows[*row][input + 2];
        change * change
    };
    over_variance(0.5 * drawn.iter().map(square).sum::<f64>(), rows, drawn)
}

/// Sum over the rows as a share of the variance; 0 of rows that do not vary.
fn over_variance(sum: f64, rows: &[Row], drawn: &[usize]) -> f64 {
    let variance = variance(rows, drawn);
    if variance > 0.0 {
        sum / drawn.len() as f64 / variance
    } else {
        0.0
    }
}

/// Variance of the two base samples together.
fn variance(rows: &[Row], drawn: &[usize]) -> f64 {
    moments::variance(&base(rows, drawn))
}

fn base(rows: &[Row], drawn: &[usize]) -> Vec<f64> {
    drawn
        .iter()
        .flat_map(|row| [rows[*row][0], rows[*row][1]])
        .collect()
}
