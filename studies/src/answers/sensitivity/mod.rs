//! Sensitivity of a quantity to the inputs.

mod elementary;
mod given_data;
mod regression;
mod variance;

pub use elementary::{ElementaryEffect, ElementaryEffects, Moment};
pub use given_data::{FirstOrderIndex, FirstOrderIndices};
pub use variance::{SobolIndex, SobolIndices};

use super::sample::{by_index, on_finest_level};
use crate::design::Design;
use crate::outcome::Member;
use crate::study::Ensemble;
use serde::{Deserialize, Serialize};

/// Sensitivity of a quantity, by the method that the design is for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = SensitivityMeasures))]
#[serde(rename_all = "snake_case")]
pub enum Measures {
    /// First-order and total indices of a Saltelli design.
    Sobol(SobolIndices),
    /// Elementary effects of Morris trajectories.
    Elementary(ElementaryEffects),
    /// First-order indices of any other design with random members.
    FirstOrder(FirstOrderIndices),
}

impl Measures {
    /// Measures for a quantity, of a body or of the whole run; none if it does not vary, if too
    /// few members have it, or of a one-at-a-time design.
    pub fn of(
        ensemble: &Ensemble,
        members: &[Member],
        name: &str,
        body: Option<usize>,
    ) -> Option<Self> {
        let known = || by_index(members, |finished| finished.quantity(name, body));
        let inputs = ensemble.inputs();
        match &ensemble.study().design {
            Design::Saltelli(design) => SobolIndices::of(design, inputs, &known()).map(Self::Sobol),
            Design::Morris(design) => {
                ElementaryEffects::of(design, inputs, &known()).map(Self::Elementary)
            }
            Design::OneAtATime(_) => None,
            _ => {
                let on_finest = on_finest_level(ensemble, members, (name, body));
                FirstOrderIndices::of(ensemble, &on_finest).map(Self::FirstOrder)
            }
        }
    }
}
