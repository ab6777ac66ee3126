//! Members of a study as jobs.

use super::outcome;
use super::study::StudyId;
use crate::jobs::store::{MemberWork, NewMember};
use crate::jobs::submit::{self, Means, ScenarioError};
use scree_studies::{Ensemble, MemberId, NoSuchMember};
use serde_json::Value;

/// These members of a study as jobs for a service with these means. One whose scenario is not
/// allowed has failed.
///
/// # Errors
/// The design has no such member.
pub(super) fn new_members(
    ensemble: &Ensemble,
    (study, ids): (StudyId, &[MemberId]),
    means: &Means,
) -> Result<Vec<NewMember>, NoSuchMember> {
    let new = ids.iter().map(|id| {
        Ok(NewMember {
            level: id.level,
            member: id.index,
            work: work(&scenario(ensemble, *id)?, study, means),
        })
    });
    new.collect()
}

/// True if a service with these means takes jobs of a scenario.
pub(super) fn is_allowed(scenario: &Value, means: &Means) -> bool {
    submit::validate(&scenario.to_string(), means, Vec::new()).is_ok()
}

/// Scenario of a member: without snapshots of the flow unless the study's asks for them, since
/// no answer is made of them.
///
/// # Errors
/// The design has no such member.
pub fn scenario(ensemble: &Ensemble, id: MemberId) -> Result<Value, NoSuchMember> {
    let mut scenario = ensemble.scenario_on(id)?;
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
