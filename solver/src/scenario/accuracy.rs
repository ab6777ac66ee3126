//! Accuracy asked of an answer, and error bars.

use super::reader::{Object, choice_words};
use super::report::Report;
use super::rules::{BUDGET, CELL_SIZE, TARGET, TARGET_BODY};
use super::{Flow, Numerics, Source};
use serde::{Deserialize, Serialize};

/// Requested accuracy of the answer, and whether it reports uncertainty intervals.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Accuracy {
    /// Coarser runs give every quantity of the outcome an uncertainty interval.
    pub error_bars: bool,
    /// Largest distance of the ends of the interval of `quantity` from its value, over the value;
    /// met by the choice of cells; `null`: `numerics` chooses them. The outcome then has intervals,
    /// too.
    pub target: Option<f64>,
    /// The outcome's key that `target` is about; `null` without a target.
    pub quantity: Option<Quantity>,
    /// Index of the body whose quantity that is.
    pub body: u32,
    /// Point-steps (sub-steps of one point) that may be spent on `target`, those of all runs
    /// together.
    pub budget_point_steps: f64,
}

impl Accuracy {
    /// True if the answer takes more than one run.
    pub fn takes_several_runs(&self) -> bool {
        self.error_bars || self.target.is_some()
    }
}

/// A quantity of the outcome, by its key.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[non_exhaustive]
pub enum Quantity {
    /// First time a body's centre is a fortieth of the body's size from its start.
    #[serde(rename = "onset_time_s")]
    Onset,
    /// Largest speed of a body's centre.
    #[serde(rename = "peak_speed_m_s")]
    PeakSpeed,
    /// Time of the largest speed of a body's centre.
    #[serde(rename = "peak_speed_time_s")]
    PeakTime,
    /// Time from which on a body is at rest.
    #[serde(rename = "stop_time_s")]
    Stop,
    /// Net horizontal displacement of a body.
    #[serde(rename = "displacement_m")]
    Displacement,
    /// Length of a body's path.
    #[serde(rename = "path_length_m")]
    PathLength,
    /// Front of the flow.
    #[serde(rename = "front_m")]
    Front,
    /// Front of the flow minus the front of the release.
    #[serde(rename = "runout_m")]
    Runout,
}

/// JSON names of the quantities.
pub(super) const QUANTITIES: [(&str, Quantity); 8] = [
    ("onset_time_s", Quantity::Onset),
    ("peak_speed_m_s", Quantity::PeakSpeed),
    ("peak_speed_time_s", Quantity::PeakTime),
    ("stop_time_s", Quantity::Stop),
    ("displacement_m", Quantity::Displacement),
    ("path_length_m", Quantity::PathLength),
    ("front_m", Quantity::Front),
    ("runout_m", Quantity::Runout),
];

impl Quantity {
    /// True if it is a body's; else it is the flow's.
    pub fn is_of_a_body(self) -> bool {
        !matches!(self, Self::Front | Self::Runout)
    }

    /// Its key in the outcome.
    pub fn key(self) -> &'static str {
        let found = QUANTITIES.iter().find(|(_, quantity)| *quantity == self);
        found.map_or("", |(key, _)| key)
    }
}

impl Accuracy {
    /// True if more than the plain answer is asked for.
    pub fn is_asked_for(&self) -> bool {
        self.error_bars || self.target.is_some()
    }

    /// The target and its quantity.
    pub fn goal(&self) -> Option<(f64, Quantity)> {
        self.target.zip(self.quantity)
    }
}

pub(super) fn read_accuracy(parent: &Object<'_>) -> Option<Accuracy> {
    let object = parent.defaulted("accuracy")?;
    let error_bars = object.flag("error_bars", false);
    let target = object.automatic(&TARGET);
    let quantity = object.choice_or_null("quantity", &QUANTITIES);
    let body = object.count(&TARGET_BODY);
    let budget_point_steps = object.number(&BUDGET);
    object.refuse_unknown();
    Some(Accuracy {
        error_bars: error_bars?,
        target: target?,
        quantity: quantity?,
        body: body?,
        budget_point_steps: budget_point_steps?,
    })
}

/// Uncertainty intervals come from coarser runs of a flow.
pub(super) fn bands_can_be_made(report: &Report, accuracy: &Accuracy, flow: Option<&Flow>) {
    let has_material = |flow: &Flow| match flow.source {
        Source::Channel { volume_m3, .. } => volume_m3 > 0.0,
        Source::Terrain { .. } => true,
    };
    if flow.is_some_and(has_material) {
        return;
    }
    if accuracy.error_bars {
        let why = "is true, but without a flow there are no cells to be coarser";
        report.refuse("/accuracy/error_bars", "false without a flow", None, why);
    }
    if accuracy.target.is_some() {
        let why = "is given, but without a flow there are no cells to be chosen";
        report.refuse("/accuracy/target", "null without a flow", None, why);
    }
}

/// A target needs a quantity, and a quantity needs a target.
pub(super) fn target_is_about_something(report: &Report, accuracy: &Accuracy) {
    let (allowed, why) = match (accuracy.target, accuracy.quantity) {
        (Some(_), None) => (
            choice_words(&QUANTITIES),
            "is null, but accuracy.target is about one of them",
        ),
        (None, Some(_)) => (
            "null without accuracy.target".to_owned(),
            "is given, but accuracy.target is not",
        ),
        _ => return,
    };
    report.refuse("/accuracy/quantity", &allowed, None, why);
}

/// The body of a target must exist. Without bodies 0 stands for none.
pub(super) fn body_is_there(report: &Report, accuracy: &Accuracy, bodies: usize) {
    let of_a_body = accuracy.quantity.is_some_and(Quantity::is_of_a_body);
    let unused = !of_a_body && accuracy.body == 0;
    if !unused && accuracy.body as usize >= bodies {
        let (allowed, why) = match bodies.checked_sub(1) {
            Some(last) => (
                format!("0 <= x <= {last}, whole"),
                format!("is {}, beyond the last body, {last}", accuracy.body),
            ),
            None => (
                if of_a_body { "nothing" } else { "0" }.to_owned() + ": there is no body",
                "is the index of a body, but there is none".to_owned(),
            ),
        };
        report.refuse("/accuracy/body", &allowed, None, &why);
    }
}

/// Cells must be chosen either by the scenario or by its target.
pub(super) fn cells_are_chosen_once(report: &Report, accuracy: &Accuracy, numerics: &Numerics) {
    if accuracy.target.is_some() && numerics.cell_size_m.is_some() {
        let pointer = format!("/numerics/{}", CELL_SIZE.key);
        let allowed = "null while accuracy.target is given";
        let why = "is given, but accuracy.target chooses the cells: give one of the two";
        report.refuse(&pointer, allowed, CELL_SIZE.unit, why);
    }
}
