//! Members of a study as jobs.

use super::outcome;
use super::study::StudyId;
use crate::jobs::store::{MemberWork, NewMember};
use crate::jobs::submit::{self, Means, ScenarioError};
use scree_studies::{Ensemble, NoSuchMember};
use serde_json::Value;
use std::ops::Range;

/// The members of these numbers of a study, as jobs for a service with these means. One whose
/// scenario is not allowed has failed.
///
/// # Errors
/// The design has no such member.
pub(super) fn new_members(
    ensemble: &Ensemble,
    (study, numbers): (StudyId, Range<u64>),
    means: &Means,
) -> Result<Vec<NewMember>, NoSuchMember> {
    numbers
        .map(|number| {
            Ok(NewMember {
                level: 0,
                member: number,
                work: work(&scenario(ensemble, number)?, study, means),
            })
        })
        .collect()
}

/// Scenario of a member: without snapshots of the flow unless the study's asks for them, since
/// no answer is made of them.
///
/// # Errors
/// The design has no such member.
pub fn scenario(ensemble: &Ensemble, number: u64) -> Result<Value, NoSuchMember> {
    let mut scenario = ensemble.scenario(number)?;
    without_snapshots(&mut scenario);
    Ok(scenario)
}

fn without_snapshots(scenario: &mut Value) {
    if let Value::Object(keys) = scenario {
        keys.entry("flow_snapshots").or_insert_with(|| 0.into());
    }
}

fn work(scenario: &Value, study: StudyId, means: &Means) -> MemberWork {
    let labels = vec![label(study)];
    match submit::validate(&scenario.to_string(), means, labels) {
        Ok(job) => MemberWork::Job(Box::new(job)),
        Err(ScenarioError::Invalid(_) | ScenarioError::Malformed { .. }) => {
            let outcome = serde_json::to_string(&outcome::not_allowed());
            MemberWork::Nothing(outcome.unwrap_or_default())
        }
    }
}

/// Label of the jobs of a study.
fn label(study: StudyId) -> String {
    format!("study:{study}")
}
