//! Observed order of convergence.

use super::findings::{Finding, Verdict};
use serde::Serialize;

/// Minimum number of resolutions for an order.
const FEWEST: usize = 3;

/// Rate at which the error of a quantity shrinks with the size of cells or steps.
#[derive(Debug, Clone, Serialize)]
pub struct Order {
    /// Quantity whose error is fitted.
    pub quantity: String,
    /// Slope of the logarithm of the error over that of the size, by least
    /// squares; none with fewer than three resolutions.
    pub fitted: Option<f64>,
    /// Order from each resolution to the next.
    pub pairwise: Vec<f64>,
    /// Labels of the resolutions used.
    pub used: Vec<String>,
    /// Labels of those left out because their error is at the floor.
    pub on_the_floor: Vec<String>,
    /// The floor: errors no larger than this have another origin.
    pub floor: f64,
    /// Least order asked for; none if it is only reported.
    pub asked: Option<f64>,
    /// Verdict from `fitted` and `asked`.
    pub verdict: Verdict,
}

impl Order {
    /// Order from the findings about one quantity.
    pub(super) fn of<'a>(
        quantity: &str,
        findings: impl Iterator<Item = &'a Finding>,
        floor: f64,
        asked: Option<f64>,
    ) -> Self {
        let mut order = Self {
            quantity: quantity.to_owned(),
            fitted: None,
            pairwise: Vec::new(),
            used: Vec::new(),
            on_the_floor: Vec::new(),
            floor,
            asked,
            verdict: Verdict::Report,
        };
        let mut places = Vec::new();
        for finding in findings {
            let (Some(size), Some(error)) = (finding.resolution.size, finding.measured_error)
            else {
                continue;
            };
            let label = finding.resolution.label.clone();
            if error.abs() <= floor {
                order.on_the_floor.push(label);
            } else {
                order.used.push(label);
                places.push((size.ln(), error.abs().ln()));
            }
        }
        order.pairwise = places.windows(2).map(slope).collect();
        order.fitted = (places.len() >= FEWEST).then(|| slope(&places));
        order.verdict = order.judged();
        order
    }

    /// An order that was asked for and can't be determined counts as failed.
    fn judged(&self) -> Verdict {
        match (self.asked, self.fitted) {
            (None, _) => Verdict::Report,
            (Some(asked), Some(fitted)) if fitted >= asked => Verdict::Pass,
            _ => Verdict::Fail,
        }
    }
}

/// Slope of the line fitted to these places.
pub(super) fn slope(places: &[(f64, f64)]) -> f64 {
    let count = places.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| places.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(|place| place.0), mean(|place| place.1));
    let spread: f64 = places.iter().map(|place| (place.0 - x).powi(2)).sum();
    let product: f64 = places
        .iter()
        .map(|place| (place.0 - x) * (place.1 - y))
        .sum();
    product / spread
}

#[cfg(test)]
mod tests {
    use super::super::findings::{Findings, Question, Resolution};
    use super::super::run::{Answer, Cost};
    use super::*;

    /// Findings with errors c · size² + floor.
    fn quadratic(sizes: &[f64], floor: f64) -> Findings {
        let mut findings = Findings::default();
        for &size in sizes {
            let values = [1.0 + 3.0 * size * size + floor];
            let answer = Answer {
                values,
                cost: Cost::default(),
            };
            let resolution = Resolution::sized(format!("{size}"), size);
            findings.take(&resolution, [Question::new("it", "m", 1.0)], Ok(answer));
        }
        findings
    }

    #[test]
    fn the_order_of_a_square_is_two() {
        let mut findings = quadratic(&[0.4, 0.2, 0.1], 0.0);
        findings.take_order("it", 0.0, Some(1.9));
        let order = &findings.orders[0];
        assert!((order.fitted.unwrap() - 2.0).abs() < 1e-9);
        assert_eq!(order.pairwise.len(), 2);
        assert_eq!(order.verdict, Verdict::Pass);
    }

    #[test]
    fn what_lies_on_the_floor_is_left_out_and_named() {
        let mut findings = quadratic(&[0.4, 0.2, 0.1, 1e-5], 1e-8);
        findings.take_order("it", 2e-8, Some(1.9));
        let order = &findings.orders[0];
        assert_eq!(order.on_the_floor, ["0.00001"]);
        assert_eq!(order.used.len(), 3);
        assert_eq!(order.verdict, Verdict::Pass);
    }

    #[test]
    fn an_order_over_two_resolutions_is_none() {
        let mut findings = quadratic(&[0.4, 0.2], 0.0);
        findings.take_order("it", 0.0, Some(1.9));
        findings.take_order("it", 0.0, None);
        let verdicts = [0, 1].map(|place: usize| findings.orders[place].verdict);
        assert_eq!(verdicts, [Verdict::Fail, Verdict::Report]);
        assert_eq!(findings.orders[0].fitted, None);
    }
}
