//! Outcomes of the members.

use crate::study::MemberId;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Member of a study with its outcome.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = StudyMember))]
#[serde(deny_unknown_fields)]
pub struct Member {
    /// Level of its cells, 0 the coarsest.
    #[serde(default, skip_serializing_if = "is_coarsest")]
    pub level: u32,
    /// Index in the design.
    pub index: u64,
    /// Outcome.
    pub outcome: MemberOutcome,
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde asks for a reference"
)]
fn is_coarsest(level: &u32) -> bool {
    *level == 0
}

/// Outcome of a member.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum MemberOutcome {
    /// The run came to its end.
    Finished(Finished),
    /// The run failed; its quantities could have been anything.
    Failed(FailedMember),
    /// The run has no outcome yet.
    Pending,
}

/// Outcome of a run that failed.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct FailedMember {
    /// Reason, one of few words so that equal reasons are counted together.
    pub reason: String,
}

impl MemberOutcome {
    /// Outcome of a run that failed for this reason.
    pub fn failed(reason: impl Into<String>) -> Self {
        Self::Failed(FailedMember {
            reason: reason.into(),
        })
    }
}

/// Outcome of a run that came to its end.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = FinishedMember))]
#[serde(deny_unknown_fields)]
pub struct Finished {
    /// Quantities of the whole run by name, the unit in the name; what did not happen is left out.
    #[serde(default)]
    pub quantities: BTreeMap<String, f64>,
    /// Bodies, in the order of the scenario.
    #[serde(default)]
    pub bodies: Vec<MemberBody>,
}

/// Body at the end of a member's run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct MemberBody {
    /// Position of its centre at the end: downstream, across, up [m].
    pub rest_m: [f64; 3],
    /// True if it still moves, so that the position is not where it rests.
    pub moving: bool,
    /// True if the flow hit it.
    pub hit: bool,
    /// Depth of its centre below the surface [m]; 0 if not below.
    pub buried_m: f64,
    /// Further quantities by name, the unit in the name, such as `displacement_m`; what did not
    /// happen is left out.
    #[serde(default)]
    pub quantities: BTreeMap<String, f64>,
}

impl Member {
    /// Member of this name with an outcome.
    pub fn new(id: MemberId, outcome: MemberOutcome) -> Self {
        Self {
            level: id.level,
            index: id.index,
            outcome,
        }
    }

    /// Member on the coarsest level, the only one of most studies.
    pub fn coarsest(index: u64, outcome: MemberOutcome) -> Self {
        Self::new(MemberId::coarsest(index), outcome)
    }

    /// Name of its run.
    pub fn id(&self) -> MemberId {
        MemberId {
            level: self.level,
            index: self.index,
        }
    }

    /// Outcome of a run that came to its end.
    pub fn finished(&self) -> Option<&Finished> {
        match &self.outcome {
            MemberOutcome::Finished(finished) => Some(finished),
            MemberOutcome::Failed(_) | MemberOutcome::Pending => None,
        }
    }
}

impl Finished {
    /// Finite quantity by name, of a body or of the whole run.
    pub fn quantity(&self, name: &str, body: Option<usize>) -> Option<f64> {
        let found = match body {
            Some(body) => self.bodies.get(body)?.quantity(name),
            None => self.quantities.get(name).copied(),
        };
        found.filter(|value| value.is_finite())
    }
}

impl MemberBody {
    /// Names of the quantities that every body has, beside those of the map.
    pub const OWN_QUANTITIES: [&str; 6] = [
        "rest_x_m", "rest_y_m", "rest_z_m", "buried_m", "moving", "hit",
    ];

    /// Quantity by name: one of the map or of [`Self::OWN_QUANTITIES`], where 1 is yes and 0 is no.
    pub fn quantity(&self, name: &str) -> Option<f64> {
        match name {
            "buried_m" => Some(self.buried_m),
            "rest_x_m" => Some(self.rest_m[0]),
            "rest_y_m" => Some(self.rest_m[1]),
            "rest_z_m" => Some(self.rest_m[2]),
            "hit" => Some(f64::from(u8::from(self.hit))),
            "moving" => Some(f64::from(u8::from(self.moving))),
            _ => self.quantities.get(name).copied(),
        }
    }

    /// Place where it rests, downstream and across [m]; none while it moves.
    pub fn resting_place(&self) -> Option<[f64; 2]> {
        let place = [self.rest_m[0], self.rest_m[1]];
        let known = !self.moving && place.iter().all(|x| x.is_finite());
        known.then_some(place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_body_has_its_own_quantities_and_no_other() {
        let body = MemberBody {
            rest_m: [1.0, 2.0, 3.0],
            moving: true,
            hit: false,
            buried_m: 0.5,
            quantities: BTreeMap::new(),
        };
        let values = MemberBody::OWN_QUANTITIES.map(|name| body.quantity(name));
        assert_eq!(values, [1.0, 2.0, 3.0, 0.5, 1.0, 0.0].map(Some));
        assert_eq!(body.quantity("displacement_m"), None);
    }
}
