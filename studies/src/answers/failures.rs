//! Counts of the members by the fate of their runs.

use crate::outcome::{Member, MemberOutcome};
use crate::study::Ensemble;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Counts of a study's members, each on every level that it is on.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = MemberCounts))]
pub struct Counts {
    /// Members whose run came to its end.
    pub finished: u64,
    /// Members whose run failed.
    pub failed: u64,
    /// Members without an outcome yet.
    pub pending: u64,
    /// Failures by reason, the most frequent first.
    pub failures: Vec<Failures>,
}

/// Failures for one reason.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = MemberFailures))]
pub struct Failures {
    /// Reason.
    pub reason: String,
    /// Number of members.
    pub members: u64,
}

impl Counts {
    /// Counts of an ensemble's members; a member that is not in the list is pending.
    pub fn of(ensemble: &Ensemble, members: &[Member]) -> Self {
        let study = ensemble.study();
        let (mut finished, mut reasons) = (0, BTreeMap::<&str, u64>::new());
        for member in members
            .iter()
            .filter(|one| one.index < study.members_on(one.level))
        {
            match &member.outcome {
                MemberOutcome::Finished(_) => finished += 1,
                MemberOutcome::Failed(failed) => *reasons.entry(&failed.reason).or_default() += 1,
                MemberOutcome::Pending => {}
            }
        }
        let failed = reasons.values().sum();
        Self {
            finished,
            failed,
            pending: study.runs().saturating_sub(finished + failed),
            failures: by_frequency(reasons),
        }
    }
}

fn by_frequency(reasons: BTreeMap<&str, u64>) -> Vec<Failures> {
    let failures = reasons.into_iter().map(|(reason, members)| Failures {
        reason: reason.to_owned(),
        members,
    });
    let mut failures: Vec<Failures> = failures.collect();
    failures.sort_by_key(|one| std::cmp::Reverse(one.members));
    failures
}
