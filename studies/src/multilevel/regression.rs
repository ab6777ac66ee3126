//! Linear regression of a quantity on its value on the next coarser level and on the inputs.

use super::selection::{centred, dot, selected};
use nalgebra::{DMatrix, DVector, SMatrix, SVector};

/// Fewest pairs that a regression is fitted to.
pub(super) const FEWEST_PAIRS: usize = 6;
/// Ridge over the diagonal of the normal equations, for columns that nearly follow from others.
const RIDGE: f64 = 1e-9;

/// Member that a regression is fitted to.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row<const D: usize> {
    /// Its index.
    pub(super) index: u64,
    /// Value on the next coarser level; none of the coarsest.
    pub(super) coarse: Option<SVector<f64, D>>,
    /// Functions of its inputs, of mean 0 over their distribution.
    pub(super) inputs: Vec<f64>,
    /// Value.
    pub(super) value: SVector<f64, D>,
}

/// Regression by least squares, each component by itself.
#[derive(Debug, Clone)]
pub(super) struct Regression<const D: usize> {
    mean: SVector<f64, D>,
    mean_coarse: SVector<f64, D>,
    mean_inputs: Vec<f64>,
    /// Change with the value on the coarser level; 0 of coarse values that do not vary.
    pub(super) slope: SMatrix<f64, D, D>,
    /// Changes of each component with functions of the inputs, by their places.
    on_inputs: [Vec<(usize, f64)>; D],
    /// Covariance of the residuals, by their degrees of freedom.
    pub(super) residual: SMatrix<f64, D, D>,
    /// Number of regressors without the mean.
    pub(super) regressors: usize,
    /// Number of rows.
    pub(super) rows: usize,
}

impl<const D: usize> Regression<D> {
    /// Regression over at least two rows, or over [`FEWEST_PAIRS`] with coarse values.
    pub(super) fn of(rows: &[Row<D>]) -> Self {
        let coarse: Vec<Vec<f64>> = (0..D)
            .filter_map(|axis| rows.iter().map(|row| Some(row.coarse?[axis])).collect())
            .collect();
        let offered = rows.first().map_or(0, |row| row.inputs.len());
        let inputs: Vec<Vec<f64>> = (0..offered)
            .map(|place| rows.iter().map(|row| row.inputs[place]).collect())
            .collect();
        let mut found = Self {
            mean: mean(rows.iter().map(|row| row.value), rows.len()),
            mean_coarse: mean(rows.iter().filter_map(|row| row.coarse), rows.len()),
            mean_inputs: inputs
                .iter()
                .map(|column| crate::moments::mean(column))
                .collect(),
            slope: SMatrix::zeros(),
            on_inputs: std::array::from_fn(|_| Vec::new()),
            residual: SMatrix::zeros(),
            regressors: coarse.len(),
            rows: rows.len(),
        };
        for axis in 0..D {
            let target: Vec<f64> = rows.iter().map(|row| row.value[axis]).collect();
            let chosen = selected(&coarse, &inputs, &target);
            let columns = coarse
                .iter()
                .chain(chosen.iter().map(|place| &inputs[*place]));
            let solved = solved(&columns.collect::<Vec<_>>(), &target);
            for (component, slope) in solved[..coarse.len()].iter().enumerate() {
                found.slope[(axis, component)] = *slope;
            }
            found.regressors = found.regressors.max(solved.len());
            let on_inputs = chosen
                .into_iter()
                .zip(solved.into_iter().skip(coarse.len()));
            found.on_inputs[axis] = on_inputs.collect();
        }
        let mut squares = SMatrix::zeros();
        for row in rows {
            let residual = found.residual_of(row);
            squares += residual * residual.transpose();
        }
        found.residual = squares / found.freedom();
        found
    }

    /// Degrees of freedom of the residuals.
    pub(super) fn freedom(&self) -> f64 {
        self.rows.saturating_sub(1 + self.regressors).max(1) as f64
    }

    /// Predicted value of a member.
    pub(super) fn predicted(
        &self,
        coarse: Option<SVector<f64, D>>,
        inputs: &[f64],
    ) -> SVector<f64, D> {
        let mut value = self.mean + self.on_inputs(inputs);
        if let Some(coarse) = coarse {
            value += self.slope * (coarse - self.mean_coarse);
        }
        value
    }

    /// Predicted mean, where that on the coarser level is known: functions of the inputs have mean
    /// 0.
    pub(super) fn predicted_mean(&self, coarse: Option<SVector<f64, D>>) -> SVector<f64, D> {
        self.predicted(coarse, &vec![0.0; self.mean_inputs.len()])
    }

    pub(super) fn residual_of(&self, row: &Row<D>) -> SVector<f64, D> {
        row.value - self.predicted(row.coarse, &row.inputs)
    }

    fn on_inputs(&self, inputs: &[f64]) -> SVector<f64, D> {
        SVector::from_fn(|axis, _| {
            let parts = self.on_inputs[axis].iter();
            parts
                .map(|(place, slope)| slope * (inputs[*place] - self.mean_inputs[*place]))
                .sum()
        })
    }
}

fn mean<const D: usize>(
    values: impl Iterator<Item = SVector<f64, D>>,
    count: usize,
) -> SVector<f64, D> {
    values.sum::<SVector<f64, D>>() / count as f64
}

/// Coefficients of the columns, without their means, that fit a target best; 0 of one that does not
/// vary.
fn solved(columns: &[&Vec<f64>], target: &[f64]) -> Vec<f64> {
    let centred_columns: Vec<Vec<f64>> = columns.iter().map(|column| centred(column)).collect();
    let lengths: Vec<f64> = centred_columns
        .iter()
        .map(|column| dot(column, column).sqrt().max(f64::MIN_POSITIVE))
        .collect();
    let target = centred(target);
    let count = columns.len();
    let product = |row: usize, column: usize| {
        let product = dot(&centred_columns[row], &centred_columns[column]);
        let ridge = if row == column { RIDGE } else { 0.0 };
        product / lengths[row] / lengths[column] + ridge
    };
    let normal = DMatrix::from_fn(count, count, product);
    let right = DVector::from_fn(count, |row, _| {
        dot(&centred_columns[row], &target) / lengths[row]
    });
    let solved = normal.cholesky().map(|cholesky| cholesky.solve(&right));
    (0..count)
        .map(|place| {
            solved
                .as_ref()
                .map_or(0.0, |solved| solved[place] / lengths[place])
        })
        .collect()
}
