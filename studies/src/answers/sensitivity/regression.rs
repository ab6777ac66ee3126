//! Regression of a quantity on one input, by classes of its values.

use crate::answers::halves::{self, SIGNS};
use crate::moments;

/// Fewest rows in a class of more than one value.
const FEWEST_IN_CLASS: usize = 8;

/// Piecewise linear regression: a line in each class of values, or the mean of the class if its
/// values are all the same.
pub(super) struct Regression {
    /// Values of the rows.
    values: Vec<f64>,
    /// Class of each row.
    class_of: Vec<usize>,
    /// Row of each datum: all in order, or those drawn in a resample.
    rows: Vec<usize>,
}

impl Regression {
    /// Regression on values: about ∛n classes of equal size, equal values never in two of them.
    pub(super) fn on(values: &[f64]) -> Self {
        let count = values.len();
        let size = count
            .div_ceil(libm::cbrt(count as f64) as usize)
            .max(FEWEST_IN_CLASS);
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by(|one, other| values[*one].total_cmp(&values[*other]));
        let mut class_of = vec![0; count];
        let (mut class, mut members) = (0, 0);
        for equal in order.chunk_by(|one, other| values[*one] == values[*other]) {
            if members > 0 && members + equal.len() > size {
                (class, members) = (class + 1, 0);
            }
            members += equal.len();
            for row in equal {
                class_of[*row] = class;
            }
        }
        Self {
            values: values.to_vec(),
            class_of,
            rows: (0..count).collect(),
        }
    }

    /// The same classes for drawn rows.
    pub(super) fn drawn(&self, rows: &[usize]) -> Self {
        let values = rows.iter().map(|row| self.values[*row]);
        let class_of = rows.iter().map(|row| self.class_of[*row]);
        Self {
            values: values.collect(),
            class_of: class_of.collect(),
            rows: rows.to_vec(),
        }
    }

    /// Number of classes.
    pub(super) fn classes(&self) -> usize {
        self.class_of.iter().max().map_or(0, |last| last + 1)
    }

    /// Share of the variance of a quantity that the regression explains, without what it fits by
    /// chance; 0 of one that does not vary.
    ///
    /// Kelley's ε² (1935) takes off what independent draws fit by chance, their variance for each
    /// parameter. A balanced design fits less. So the chance is measured: the signs of one half of
    /// the residuals are turned, and what the regression fits to these is chance alone. Fitted
    /// residuals lack the share p/n of the variance, for p parameters of n rows.
    pub(super) fn explained(&self, quantities: &[f64]) -> f64 {
        let given: Vec<f64> = self.rows.iter().map(|row| quantities[*row]).collect();
        let (mean, count) = (moments::mean(&given), given.len());
        let centred: Vec<f64> = given.iter().map(|one| one - mean).collect();
        let (fitted, parameters) = self.fitted(&centred);
        let residuals: Vec<f64> = centred
            .iter()
            .zip(&fitted)
            .map(|(y, fit)| y - fit)
            .collect();
        let by_chance = SIGNS.map(|signs| {
            let turned = residuals.iter().enumerate();
            let turned = turned.map(|(place, one)| one * halves::sign(signs, place, count));
            squares(&self.fitted(&turned.collect::<Vec<f64>>()).0)
        });
        let by_chance = moments::mean(&by_chance) / (1.0 - parameters as f64 / count as f64);
        let all = squares(&centred);
        if all > 0.0 && parameters < count {
            (squares(&fitted) - by_chance) / all
        } else {
            0.0
        }
    }

    /// Regression of numbers on the values, and the number of parameters.
    fn fitted(&self, numbers: &[f64]) -> (Vec<f64>, usize) {
        let mut by_class = vec![Vec::new(); self.classes()];
        for (place, class) in self.class_of.iter().enumerate() {
            by_class[*class].push(place);
        }
        let mut fitted = vec![0.0; numbers.len()];
        let mut parameters = 0;
        for places in &by_class {
            let line = Line::through(places, &self.values, numbers);
            parameters += line.parameters;
            for place in places {
                fitted[*place] = line.at(self.values[*place]);
            }
        }
        (fitted, parameters)
    }
}

/// Regression line of a class.
struct Line {
    middle: f64,
    mean: f64,
    slope: f64,
    parameters: usize,
}

impl Line {
    fn through(places: &[usize], values: &[f64], numbers: &[f64]) -> Self {
        let values: Vec<f64> = places.iter().map(|place| values[*place]).collect();
        let numbers: Vec<f64> = places.iter().map(|place| numbers[*place]).collect();
        let spread = moments::variance(&values);
        let slopes = spread > 0.0 && places.len() > 2;
        Self {
            middle: moments::mean(&values),
            mean: moments::mean(&numbers),
            slope: if slopes {
                moments::covariance(&values, &numbers) / spread
            } else {
                0.0
            },
            parameters: places.len().min(1) + usize::from(slopes),
        }
    }

    fn at(&self, value: f64) -> f64 {
        self.mean + self.slope * (value - self.middle)
    }
}

fn squares(numbers: &[f64]) -> f64 {
    numbers.iter().map(|one| one * one).sum()
}
