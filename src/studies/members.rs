//! Members of a study as jobs.

use super::outcome;
use super::study::StudyId;
use crate::jobs::JobService;
use crate::jobs::store::{MemberWork, NewMember, StoreError};
use crate::terrains::ReadError;
use scree_studies::{Ensemble, MemberId, NoSuchMember};
use serde_json::Value;
use thiserror::Error;

/// Reason why members can't be made now.
#[derive(Debug, Error)]
pub(super) enum NewMembersError {
    /// The design has no such member.
    #[error(transparent)]
    Member(#[from] NoSuchMember),
    /// The maps of their scenarios can't be had.
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// These members of a study as jobs for a service. One whose scenario is not allowed has failed.
///
/// # Errors
/// The design has no such member; or the store's own.
pub(super) fn new_members(
    ensemble: &Ensemble,
    (study, ids): (StudyId, &[MemberId]),
    jobs: &JobService,
) -> Result<Vec<NewMember>, NewMembersError> {
    let new = ids.iter().map(|id| {
        Ok(NewMember {
            level: id.level,
            member: id.index,
            work: work(&scenario(ensemble, *id)?, study, jobs)?,
        })
    });
    new.collect()
}

/// True if a service takes jobs of a scenario.
pub(super) fn is_allowed(scenario: &Value, jobs: &JobService) -> bool {
    jobs.validate(&scenario.to_string(), Vec::new()).is_ok()
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

fn work(scenario: &Value, study: StudyId, jobs: &JobService) -> Result<MemberWork, StoreError> {
    let labels = vec![label(study)];
    match jobs.validate(&scenario.to_string(), labels) {
        Ok(job) => Ok(MemberWork::Job(Box::new(job))),
        Err(ReadError::Scenario(_)) => {
            let outcome = serde_json::to_string(&outcome::not_allowed());
            Ok(MemberWork::Nothing(outcome.unwrap_or_default()))
        }
        Err(ReadError::Store(error)) => Err(error),
    }
}

/// Label of the jobs of a study.
fn label(study: StudyId) -> String {
    format!("study:{study}")
}
