//! Cost of a run, and the parts of its scene that are computed, determined before the run
//! (docs/method.md, section 12; docs/plan.md).

mod choices;
mod cost;
mod course;
mod hints;
mod memory;
mod names;

pub use choices::Choice;
pub use cost::{Cost, Stage};
pub use hints::Hint;
pub(crate) use names::names;

use crate::error::SetupError;
use crate::scenario::Scenario;
use crate::simulation::PreparedScene;
use serde::{Deserialize, Serialize};

/// Plan of a run: its computation, its reductions with their reasons, and its cost.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Plan {
    /// Every reduction that was considered.
    pub choices: Vec<Choice>,
    /// Warnings to check before the run; absent from plans of an older version.
    pub hints: Vec<Hint>,
    /// Cost of the run.
    pub cost: Cost,
}

impl Plan {
    /// Plan of a scenario's run.
    ///
    /// # Errors
    /// Too many points for one run, or a requested reduction that the scene does not allow.
    pub fn new(scenario: &Scenario) -> Result<Self, SetupError> {
        Ok(Self::of(&PreparedScene::of(scenario)?))
    }

    /// Plan of a prepared scene's run.
    pub fn of(prepared: &PreparedScene) -> Self {
        Self {
            choices: choices::of(prepared),
            hints: hints::of(prepared),
            cost: Cost::of(prepared),
        }
    }
}
