//! The study document.

mod accuracy;
mod check;
mod ends;
mod ensemble;
mod levels;
mod pointer;
mod question;
mod sizes;
mod stop;
mod violation;

pub use accuracy::Accuracy;
pub use ends::{End, EndScenario};
pub use ensemble::{Ensemble, NoSuchMember};
pub(crate) use levels::{FEWEST_MEMBERS, MOST_FINER};
pub use levels::{FinerLevel, MemberId};
pub use question::{Buried, Exceeds, Mean, Quantiles, Question, Rest, Sensitivity};
pub use stop::{Progress, Stop, Verdict};
pub use violation::Violation;

use crate::correlation::Correlation;
use crate::design::Design;
use crate::distribution::Distribution;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Study: a scenario, its uncertain inputs, the design of the members, and the questions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct Study {
    /// Free text.
    #[serde(default)]
    pub title: String,
    /// Scenario that every member changes; what is in it is none of the study's business.
    pub scenario: Value,
    /// Uncertain inputs, at least one.
    pub inputs: Vec<Input>,
    /// Rank correlations of pairs of inputs; all other pairs are independent.
    #[serde(default)]
    pub correlations: Vec<Correlation>,
    /// Design of the members.
    pub design: Design,
    /// Levels of finer cells, the coarsest first, beside the scenario's own cells, level 0; none: the
    /// scenario's alone.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub finer_levels: Vec<FinerLevel>,
    /// Accuracy that members and finer levels are added for; none: the levels as they are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<Accuracy>,
    /// Rule that enlarges the design until the answer is settled; none: the design as it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stop: Option<Stop>,
    /// Questions to be answered.
    #[serde(default)]
    pub questions: Vec<Question>,
}

/// Uncertain input.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = StudyInput))]
#[serde(deny_unknown_fields)]
pub struct Input {
    /// Place in the scenario, a JSON pointer (RFC 6901) to what is there or to a new key of an
    /// object that is there.
    pub pointer: String,
    /// Distribution; an explicit design does not need it and does not look at it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub distribution: Option<Distribution>,
}

impl Study {
    /// All that is wrong with the study, in the order of the document.
    pub fn violations(&self) -> Vec<Violation> {
        check::violations(self)
    }

    /// Number of members of the design, those of level 0.
    pub fn members(&self) -> u64 {
        self.design.members(self.inputs.len())
    }
}
