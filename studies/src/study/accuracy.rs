//! Accuracy asked of a study.

use super::{Study, Violation, question};
use serde::{Deserialize, Serialize};

/// Target of the accuracy of a mean: members and finer levels are added until sampling error and
/// numerical error together are within it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = StudyAccuracy))]
#[serde(deny_unknown_fields)]
pub struct Accuracy {
    /// Name of the quantity whose mean it is about.
    pub quantity: String,
    /// Index of the body whose quantity it is; none: one of the whole run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<usize>,
    /// Largest distance of the ends of the mean's interval from the mean, over the mean,
    /// 0.001 <= x <= 1.
    pub target: f64,
    /// Smallest cells that may be taken [m]; none: no limit but those of a scenario.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub finest_cell_size_m: Option<f64>,
    /// Most work in point-steps, 1e12 if left out.
    #[serde(default = "default_budget")]
    pub budget_point_steps: f64,
}

/// Budget if none is given: fourteen hours of a core at 20 million point-steps a second. A mean
/// near 0, whose error is never small against it, must not take work without end.
fn default_budget() -> f64 {
    1e12
}

impl Accuracy {
    /// True if cells of a size are not smaller than the smallest.
    pub(crate) fn takes_cells(&self, cell_size_m: f64) -> bool {
        self.finest_cell_size_m
            .is_none_or(|least| cell_size_m >= least)
    }

    /// All that is wrong with it in its study; each pointer begins at it.
    pub(super) fn violations(&self, study: &Study) -> Vec<Violation> {
        let mut found = question::name(&self.quantity);
        if !(0.001..=1.0).contains(&self.target) {
            found.push(Violation::of("/target", self.target, "0.001 <= x <= 1"));
        }
        let numbers = [
            ("/finest_cell_size_m", self.finest_cell_size_m, "x > 0 [m]"),
            (
                "/budget_point_steps",
                Some(self.budget_point_steps),
                "x > 0",
            ),
        ];
        for (pointer, number, allowed) in numbers {
            if let Some(number) = number.filter(|number| number.is_nan() || *number <= 0.0) {
                found.push(Violation::of(pointer, number, allowed));
            }
        }
        if study.stop.is_some() {
            let message = "accuracy decides how many members there are, allowed: without stop";
            found.push(Violation::new("", message));
        }
        found
    }
}
