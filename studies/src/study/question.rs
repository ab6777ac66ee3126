//! Questions of a study.

use super::Violation;
use crate::design::Design;
use serde::{Deserialize, Serialize};

/// Question to a study.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = StudyQuestion))]
#[serde(rename_all = "snake_case")]
pub enum Question {
    /// Where a body comes to rest.
    Rest(Rest),
    /// Probability that a quantity exceeds thresholds.
    Exceeds(Exceeds),
    /// Probability that a body ends below the surface.
    Buried(Buried),
    /// Mean of a quantity.
    Mean(Mean),
    /// Quantiles of a quantity.
    Quantiles(Quantiles),
    /// Inputs that a quantity depends on.
    Sensitivity(Sensitivity),
}

/// Question where a body comes to rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = RestQuestion))]
#[serde(deny_unknown_fields)]
pub struct Rest {
    /// Index of the body in the scenario.
    pub body: usize,
    /// Probabilities of the regions, each 0 < p < 1.
    pub regions: Vec<f64>,
}

/// Question how likely a quantity exceeds thresholds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = ExceedsQuestion))]
#[serde(deny_unknown_fields)]
pub struct Exceeds {
    /// Name of the quantity in the members' outcomes.
    pub quantity: String,
    /// Index of the body whose quantity it is; none: one of the whole run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<usize>,
    /// Thresholds, in the unit of the quantity.
    pub thresholds: Vec<f64>,
}

/// Question how likely a body ends below the surface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = BuriedQuestion))]
#[serde(deny_unknown_fields)]
pub struct Buried {
    /// Index of the body in the scenario.
    pub body: usize,
    /// Depth below the surface that is exceeded [m], not negative.
    pub deeper_than_m: f64,
}

/// Question for the mean of a quantity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = MeanQuestion))]
#[serde(deny_unknown_fields)]
pub struct Mean {
    /// Name of the quantity in the members' outcomes.
    pub quantity: String,
    /// Index of the body whose quantity it is; none: one of the whole run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<usize>,
}

/// Question for quantiles of a quantity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = QuantilesQuestion))]
#[serde(deny_unknown_fields)]
pub struct Quantiles {
    /// Name of the quantity in the members' outcomes.
    pub quantity: String,
    /// Index of the body whose quantity it is; none: one of the whole run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<usize>,
    /// Probabilities of the quantiles, each 0 < p < 1.
    pub probabilities: Vec<f64>,
}

/// Question which inputs a quantity depends on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = SensitivityQuestion))]
#[serde(deny_unknown_fields)]
pub struct Sensitivity {
    /// Name of the quantity in the members' outcomes.
    pub quantity: String,
    /// Index of the body whose quantity it is; none: one of the whole run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<usize>,
}

impl Question {
    /// All that is wrong with the question to a design; each pointer begins at the question.
    pub(super) fn violations(&self, design: &Design) -> Vec<Violation> {
        let (key, mut found) = match self {
            Self::Rest(rest) => ("rest", probabilities("regions", &rest.regions)),
            Self::Exceeds(exceeds) => ("exceeds", exceeds.violations()),
            Self::Buried(buried) => ("buried", buried.violations()),
            Self::Mean(mean) => ("mean", name(&mean.quantity)),
            Self::Quantiles(quantiles) => ("quantiles", quantiles.violations()),
            Self::Sensitivity(sensitivity) => ("sensitivity", name(&sensitivity.quantity)),
        };
        found.extend(self.unanswerable(design));
        Violation::under(&format!("/{key}"), found)
    }

    /// A question that the design cannot answer.
    fn unanswerable(&self, design: &Design) -> Option<Violation> {
        let message = match (self, design) {
            (Self::Sensitivity(_), Design::OneAtATime(_)) => {
                "sensitivity needs a saltelli, morris or random design, not one_at_a_time"
            }
            (Self::Sensitivity(_), _) => return None,
            _ if design.has_draws() => return None,
            _ => "a probability needs a design of random members, not morris or one_at_a_time",
        };
        Some(Violation::new("", message))
    }
}

impl Exceeds {
    fn violations(&self) -> Vec<Violation> {
        let finite = |threshold: f64| threshold.is_finite();
        let mut found = name(&self.quantity);
        found.extend(list(
            "thresholds",
            &self.thresholds,
            "a finite number",
            finite,
        ));
        found
    }
}

impl Buried {
    fn violations(&self) -> Vec<Violation> {
        let right = self.deeper_than_m >= 0.0 && self.deeper_than_m.is_finite();
        let wrong = || Violation::of("/deeper_than_m", self.deeper_than_m, "x >= 0 [m]");
        (!right).then(wrong).into_iter().collect()
    }
}

impl Quantiles {
    fn violations(&self) -> Vec<Violation> {
        let mut found = name(&self.quantity);
        found.extend(probabilities("probabilities", &self.probabilities));
        found
    }
}

/// Violation of the name of a quantity.
pub(super) fn name(quantity: &str) -> Vec<Violation> {
    let wrong = || Violation::new("/quantity", "quantity is empty, allowed: a name");
    quantity.is_empty().then(wrong).into_iter().collect()
}

fn probabilities(key: &str, given: &[f64]) -> Vec<Violation> {
    list(key, given, "0 < x < 1", |one| one > 0.0 && one < 1.0)
}

/// Violations of a list of numbers, which is not empty.
fn list(key: &str, given: &[f64], allowed: &str, right: fn(f64) -> bool) -> Vec<Violation> {
    if given.is_empty() {
        let message = format!("{key} is empty, allowed: at least one number");
        return vec![Violation::new(&format!("/{key}"), message)];
    }
    let wrong = given.iter().enumerate().filter(|(_, one)| !right(**one));
    let violation =
        |(place, one): (usize, &f64)| Violation::of(&format!("/{key}/{place}"), one, allowed);
    wrong.map(violation).collect()
}
