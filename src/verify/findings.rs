//! Findings of a case: measured values against the reference solution, and verdicts.

use super::limit::Limit;
use super::order::Order;
use super::run::{Answer, CaseError, Cost};
use serde::Serialize;

/// Question: a quantity, its reference solution, and the tolerance of the computation.
#[derive(Debug, Clone, Serialize)]
pub struct Question {
    /// Quantity that is measured.
    pub quantity: String,
    /// Unit of the quantity.
    pub unit: &'static str,
    /// Reference value.
    pub reference: f64,
    /// Normalisation of the error.
    pub error: Error,
    /// Largest error allowed; none if it is only reported.
    pub tolerance: Option<f64>,
}

/// Normalisation of an error.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Error {
    /// As a share of the reference solution.
    Relative,
    /// In the quantity's own unit.
    Absolute,
    /// As a share of another quantity.
    Over {
        /// Name.
        of: &'static str,
        /// Its size, in the quantity's unit.
        size: f64,
    },
}

impl Question {
    /// A question whose error is a share of the reference solution, without a tolerance.
    pub fn new(quantity: impl Into<String>, unit: &'static str, reference: f64) -> Self {
        Self {
            quantity: quantity.into(),
            unit,
            reference,
            error: Error::Relative,
            tolerance: None,
        }
    }

    /// Normalises the error another way.
    #[must_use]
    pub fn by(mut self, error: Error) -> Self {
        self.error = error;
        self
    }

    /// Sets the tolerance.
    #[must_use]
    pub fn within(mut self, tolerance: f64) -> Self {
        self.tolerance = Some(tolerance);
        self
    }

    /// Error of a measured value, with its sign.
    fn error_of(&self, measured: f64) -> f64 {
        let off = measured - self.reference;
        match self.error {
            Error::Relative => off / self.reference.abs(),
            Error::Absolute => off,
            Error::Over { size, .. } => off / size,
        }
    }
}

/// Resolution of a computation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Resolution {
    /// Label.
    pub label: String,
    /// Length of a cell or of a step, in the unit of the label; none
    /// if nothing was divided.
    pub size: Option<f64>,
}

impl Resolution {
    /// With a size over which an order can be taken.
    pub fn sized(label: impl Into<String>, size: f64) -> Self {
        Self {
            label: label.into(),
            size: Some(size),
        }
    }

    /// With a label only.
    pub fn named(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            size: None,
        }
    }
}

/// Verdict by error and tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Within the tolerance.
    Pass,
    /// Beyond it, NaN, or the run failed.
    Fail,
    /// No tolerance.
    Report,
}

impl Verdict {
    /// Verdict on the size of an error; NaN is beyond every tolerance.
    fn of(error: f64, tolerance: Option<f64>) -> Self {
        match tolerance {
            None if error.is_finite() => Self::Report,
            Some(tolerance) if error.abs() <= tolerance => Self::Pass,
            _ => Self::Fail,
        }
    }
}

/// One measured value.
#[derive(Debug, Clone, Serialize)]
pub struct Finding {
    /// Question that was asked.
    #[serde(flatten)]
    pub question: Question,
    /// Resolution of the computation.
    pub resolution: Resolution,
    /// Measured value; none if the run failed.
    pub measured: Option<f64>,
    /// Error by the question's normalisation; none if the run failed.
    pub measured_error: Option<f64>,
    /// Reason why the run failed.
    pub failure: Option<String>,
    /// Computed from error and tolerance.
    pub verdict: Verdict,
    /// Cost.
    pub cost: Cost,
}

impl Finding {
    fn measured(question: Question, resolution: Resolution, value: f64, cost: Cost) -> Self {
        let error = question.error_of(value);
        Self {
            verdict: Verdict::of(error, question.tolerance),
            measured: Some(value),
            measured_error: Some(error),
            failure: None,
            question,
            resolution,
            cost,
        }
    }

    fn failed(question: Question, resolution: Resolution, error: &CaseError) -> Self {
        Self {
            verdict: Verdict::Fail,
            measured: None,
            measured_error: None,
            failure: Some(error.to_string()),
            question,
            resolution,
            cost: Cost::default(),
        }
    }
}

/// Everything a case found.
#[derive(Debug, Default, Serialize)]
pub struct Findings {
    /// Values, in the order they were measured.
    pub values: Vec<Finding>,
    /// Orders of convergence.
    pub orders: Vec<Order>,
    /// Limits of vanishing cells.
    pub limits: Vec<Limit>,
}

impl Findings {
    /// Adds the answers of one run to these questions; a run that failed
    /// answers none of them.
    pub fn take<const N: usize>(
        &mut self,
        resolution: &Resolution,
        questions: [Question; N],
        answer: Result<Answer<N>, CaseError>,
    ) {
        let resolution = || resolution.clone();
        match answer {
            Ok(Answer { values, cost }) => {
                for (question, value) in questions.into_iter().zip(values) {
                    let finding = Finding::measured(question, resolution(), value, cost);
                    self.values.push(finding);
                }
            }
            Err(error) => {
                for question in questions {
                    let finding = Finding::failed(question, resolution(), &error);
                    self.values.push(finding);
                }
            }
        }
    }

    /// Adds the order at which the errors of a quantity shrink with the size
    /// of its resolutions. Errors no larger than `floor` are left out of it.
    pub fn take_order(&mut self, quantity: &str, floor: f64, asked: Option<f64>) {
        let order = Order::of(quantity, self.of(quantity), floor, asked);
        self.orders.push(order);
    }

    /// Adds the limit of a quantity as cells get finer.
    pub fn take_limit(&mut self, quantity: &str) {
        let limit = Limit::of(quantity, self.of(quantity));
        self.limits.push(limit);
    }

    /// Number of verdicts of each kind.
    pub fn count(&self) -> Count {
        let verdicts = self.values.iter().map(|finding| finding.verdict);
        let orders = self.orders.iter().map(|order| order.verdict);
        let mut count = Count::default();
        for verdict in verdicts.chain(orders) {
            match verdict {
                Verdict::Pass => count.passed += 1,
                Verdict::Fail => count.failed += 1,
                Verdict::Report => count.reported += 1,
            }
        }
        count
    }

    /// The values of a quantity.
    pub fn of<'a>(&'a self, quantity: &'a str) -> impl Iterator<Item = &'a Finding> {
        let values = self.values.iter();
        values.filter(move |finding| finding.question.quantity == quantity)
    }
}

/// Number of verdicts of each kind.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Count {
    /// Within the tolerance.
    pub passed: usize,
    /// Beyond it.
    pub failed: usize,
    /// Without one.
    pub reported: usize,
}

impl Count {
    /// Sum of both.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            passed: self.passed + other.passed,
            failed: self.failed + other.failed,
            reported: self.reported + other.reported,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(question: Question, value: f64) -> Verdict {
        let resolution = Resolution::named("one");
        Finding::measured(question, resolution, value, Cost::default()).verdict
    }

    #[test]
    fn error_and_bar_make_the_verdict() {
        let question = || Question::new("speed", "m/s", -2.0).within(0.01);
        assert_eq!(verdict(question(), -2.019), Verdict::Pass);
        assert_eq!(verdict(question(), -1.979), Verdict::Fail);
        assert_eq!(verdict(question(), f64::NAN), Verdict::Fail);
        assert_eq!(
            verdict(question().by(Error::Absolute), -1.979),
            Verdict::Fail
        );
        let over = Error::Over {
            of: "g",
            size: 9.81,
        };
        assert_eq!(verdict(question().by(over), -1.979), Verdict::Pass);
        assert_eq!(
            verdict(Question::new("speed", "m/s", 1.0), 7.0),
            Verdict::Report
        );
    }

    #[test]
    fn a_failed_run_is_a_miss_even_without_a_bar() {
        let mut findings = Findings::default();
        let question = Question::new("speed", "m/s", 1.0);
        let error = CaseError::Scene("none".to_owned());
        findings.take(&Resolution::named("one"), [question], Err(error));
        assert_eq!(findings.count().failed, 1);
    }
}
