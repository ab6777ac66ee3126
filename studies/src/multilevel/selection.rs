//! Selection of regressors.

/// Rows that the selection looks at; of more, the first.
const LOOKED_AT: usize = 1024;
/// Most regressors of all.
const MOST: usize = 12;
/// Rows for each parameter of the regression, at least.
const ROWS_PER_PARAMETER: usize = 3;
/// Largest share of the prediction error that a regressor leaves which is worth taking.
const WORTH_TAKING: f64 = 0.85;
/// Length of a column over its former one below which it follows from others.
const DEPENDENT: f64 = 1e-6;
/// Distance from the mean, over the mean, that is rounding.
const ROUNDING: f64 = 1e-12;

/// Offered columns, by their places, that predict a target well beside those that are taken anyway:
/// forward selection by the prediction sum of squares (PRESS, Allen 1974), the error of each row
/// predicted without it.
pub(super) fn selected(taken: &[Vec<f64>], offered: &[Vec<f64>], target: &[f64]) -> Vec<usize> {
    let rows = target.len().min(LOOKED_AT);
    let mut fit = Fit::of_mean(&target[..rows]);
    for column in taken {
        fit.take(centred(&column[..rows]));
    }
    let most = (rows / ROWS_PER_PARAMETER).min(MOST + 1);
    let mut left: Vec<Option<Vec<f64>>> = offered
        .iter()
        .map(|column| Some(fit.independent(centred(&column[..rows]))))
        .collect();
    let mut found = Vec::new();
    while 1 + taken.len() + found.len() < most {
        let explained = |column: &Vec<f64>| {
            let along = dot(column, &fit.residuals);
            along * along / dot(column, column)
        };
        let candidates = left.iter().enumerate();
        let explained = candidates.filter_map(|(place, column)| {
            let column = column.as_ref().filter(|column| dot(column, column) > 0.0)?;
            Some((place, explained(column)))
        });
        let best = explained.fold(None, |best: Option<(usize, f64)>, one| match best {
            Some(best) if best.1 >= one.1 => Some(best),
            _ => Some(one),
        });
        let Some((place, column)) = best.and_then(|(place, _)| Some((place, left[place].take()?)))
        else {
            break;
        };
        let before = fit.prediction_error();
        let mut with = fit.clone();
        with.take(column);
        if with.prediction_error() > WORTH_TAKING * before {
            break;
        }
        fit = with;
        for column in left.iter_mut().flatten() {
            let last = fit.basis.len() - 1;
            without_direction(column, &fit.basis[last]);
        }
        found.push(place);
    }
    found.sort_unstable();
    found
}

/// Least-squares fit on orthonormal columns.
#[derive(Clone)]
struct Fit {
    basis: Vec<Vec<f64>>,
    residuals: Vec<f64>,
    /// Leverage of each row.
    leverage: Vec<f64>,
}

impl Fit {
    fn of_mean(target: &[f64]) -> Self {
        Self {
            basis: Vec::new(),
            residuals: centred(target),
            leverage: vec![1.0 / target.len() as f64; target.len()],
        }
    }

    /// Column without what follows from the basis; of zeros if that is all of it.
    fn independent(&self, mut column: Vec<f64>) -> Vec<f64> {
        let before = dot(&column, &column);
        for direction in &self.basis {
            without_direction(&mut column, direction);
        }
        if dot(&column, &column) <= DEPENDENT * DEPENDENT * before {
            column.fill(0.0);
        }
        column
    }

    /// Takes a column into the fit.
    fn take(&mut self, column: Vec<f64>) {
        let mut column = self.independent(column);
        let length = dot(&column, &column).sqrt();
        if length == 0.0 {
            return;
        }
        for value in &mut column {
            *value /= length;
        }
        without_direction(&mut self.residuals, &column);
        for (leverage, value) in self.leverage.iter_mut().zip(&column) {
            *leverage += value * value;
        }
        self.basis.push(column);
    }

    /// Sum of the squared errors of rows predicted without themselves.
    fn prediction_error(&self) -> f64 {
        let rows = self.residuals.iter().zip(&self.leverage);
        let errors = rows.map(|(residual, leverage)| residual / (1.0 - leverage).max(f64::EPSILON));
        errors.map(|error| error * error).sum()
    }
}

/// Takes the part along a direction of length 1 off a column.
fn without_direction(column: &mut [f64], direction: &[f64]) {
    let along = dot(column, direction);
    for (value, part) in column.iter_mut().zip(direction) {
        *value -= along * part;
    }
}

/// Column without its mean; zeros, not their rounding, of one that does not vary.
pub(super) fn centred(column: &[f64]) -> Vec<f64> {
    let mean = crate::moments::mean(column);
    let centred: Vec<f64> = column.iter().map(|value| value - mean).collect();
    let varies = |value: &f64| value.abs() > ROUNDING * mean.abs();
    match centred.iter().any(varies) {
        true => centred,
        false => vec![0.0; column.len()],
    }
}

pub(super) fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Purpose, Random};

    fn noise(seed: u64) -> Vec<f64> {
        let mut random = Random::new(Purpose::Bootstrap, seed, [0, 0]);
        (0..64).map(|_| random.unit() - 0.5).collect()
    }

    #[test]
    fn what_predicts_is_taken_and_noise_is_not() {
        let offered: Vec<Vec<f64>> = (0..8).map(noise).collect();
        let rest = noise(99);
        let row = |row: usize| 3.0 * offered[2][row] - offered[5][row] + 0.2 * rest[row];
        let target: Vec<f64> = (0..64).map(row).collect();
        assert_eq!(selected(&[], &offered, &target), [2, 5]);
        let taken = [offered[2].clone()];
        assert_eq!(selected(&taken, &offered, &target), [5]);
        let of_noise = (100..130).map(|seed| selected(&[], &offered, &noise(seed)).len());
        assert!(of_noise.sum::<usize>() < 15);
    }

    #[test]
    fn a_column_that_does_not_vary_has_no_rounding_left() {
        for value in [0.1, 0.35, -7.3e5, 0.0] {
            assert_eq!(centred(&[value; 16]), [0.0; 16]);
        }
    }

    #[test]
    fn few_rows_allow_few_regressors() {
        let offered: Vec<Vec<f64>> = (0..8).map(|seed| noise(seed)[..12].to_vec()).collect();
        let row = |row: usize| offered.iter().map(|column| column[row]).sum();
        let target: Vec<f64> = (0..12).map(row).collect();
        assert!(selected(&[], &offered, &target).len() <= 3);
    }
}
