//! Rule that stops the enlargement of a design.

use super::{Question, Study, Violation};
use serde::{Deserialize, Serialize};

/// Stopping rule: the design is doubled until the regions' area settles or a limit is reached.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = StoppingRule))]
#[serde(deny_unknown_fields)]
pub struct Stop {
    /// Probability of the region that is watched; the rest questions have it.
    pub region: f64,
    /// Relative change of the region's area by a doubling below which the answer is settled.
    pub area_changes_less_than: f64,
    /// Most members.
    pub max_members: u64,
    /// Most work in point-steps; none: no limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub budget_point_steps: Option<f64>,
}

/// Progress of a study at the end of a design.
#[derive(Debug, Clone, PartialEq)]
pub struct Progress {
    /// Areas of the watched region before the last doubling and after it [m²], one pair for each
    /// rest question.
    pub areas_m2: Vec<[f64; 2]>,
    /// Number of members so far.
    pub members: u64,
    /// Work so far [point-steps].
    pub point_steps: f64,
}

/// Verdict of a stopping rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The answer is settled.
    Settled,
    /// A doubling would exceed the most members.
    TooManyMembers,
    /// A doubling would exceed the budget.
    TooMuchWork,
    /// The design is to be doubled.
    Double,
}

impl Stop {
    /// Verdict at the end of a design. A doubling is taken to cost as much again as all so far.
    pub fn verdict(&self, progress: &Progress) -> Verdict {
        let settled = |[before, after]: &[f64; 2]| {
            (after - before).abs() <= self.area_changes_less_than * before.max(*after)
        };
        let budget = self.budget_point_steps.unwrap_or(f64::INFINITY);
        if !progress.areas_m2.is_empty() && progress.areas_m2.iter().all(settled) {
            Verdict::Settled
        } else if progress.members.saturating_mul(2) > self.max_members {
            Verdict::TooManyMembers
        } else if 2.0 * progress.point_steps > budget {
            Verdict::TooMuchWork
        } else {
            Verdict::Double
        }
    }

    /// All that is wrong with the rule in its study; each pointer begins at the rule.
    pub(super) fn violations(&self, study: &Study) -> Vec<Violation> {
        let mut found = Vec::new();
        found.extend(self.unwatched(study));
        if !(self.area_changes_less_than > 0.0 && self.area_changes_less_than < 1.0) {
            let given = self.area_changes_less_than;
            found.push(Violation::of("/area_changes_less_than", given, "0 < x < 1"));
        }
        if self.max_members < study.members() {
            let allowed = format!("x >= {}, the members of the design", study.members());
            found.push(Violation::of("/max_members", self.max_members, allowed));
        }
        if let Some(budget) = self
            .budget_point_steps
            .filter(|budget| budget.is_nan() || *budget <= 0.0)
        {
            found.push(Violation::of("/budget_point_steps", budget, "x > 0"));
        }
        if study.design.doubled().is_none() {
            let message = "a stopping rule needs a design that can be enlarged: sobol or saltelli";
            found.push(Violation::new("", message));
        }
        found
    }

    /// A region that no rest question asks for.
    fn unwatched(&self, study: &Study) -> Option<Violation> {
        let watched = study.questions.iter().any(|question| {
            matches!(question, Question::Rest(rest) if rest.regions.contains(&self.region))
        });
        let allowed = "a probability that a rest question has among its regions";
        (!watched).then(|| Violation::of("/region", self.region, allowed))
    }
}
