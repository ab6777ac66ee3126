//! Plan of a study: what its members cost.

use super::members::scenario;
use scree_solver::plan::Cost;
use scree_solver::scenario::Scenario;
use scree_solver::simulation::PreparedScene;
use scree_studies::Ensemble;
use serde::Serialize;
use serde_json::Value;
use utoipa::ToSchema;

/// Most members whose cost is found; of a larger study, members spread over the design stand for
/// the others.
const COSTED: u64 = 32;

/// Cost of the members of a study.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, ToSchema)]
#[schema(as = StudyCost)]
pub struct StudyCost {
    /// Members of the design.
    pub members: u64,
    /// Most members, if a stopping rule enlarges the design; else those of the design.
    pub max_members: u64,
    /// Members whose cost was found; the others are taken to cost as much on average.
    pub members_costed: u64,
    /// Mean work of a member [point-steps].
    pub point_steps_per_member: f64,
    /// Work of all members of the design [point-steps].
    pub point_steps: f64,
    /// Largest memory of a member [bytes].
    pub member_memory_bytes: u64,
}

/// Cost of a study; members that can't be set up are left out. `None` if that is all of them.
pub fn cost(ensemble: &Ensemble) -> Option<StudyCost> {
    let members = ensemble.members();
    let costs: Vec<Cost> = spread(members)
        .filter_map(|number| cost_of(&scenario(ensemble, number).ok()?))
        .collect();
    let memory = costs.iter().map(|cost| cost.memory_bytes).max()?;
    let work: f64 = costs.iter().map(|cost| cost.point_steps as f64).sum();
    let per_member = work / costs.len() as f64;
    let stop = ensemble.study().stop.as_ref();
    Some(StudyCost {
        members,
        max_members: stop.map_or(members, |stop| stop.max_members.max(members)),
        members_costed: costs.len() as u64,
        point_steps_per_member: per_member,
        point_steps: per_member * members as f64,
        member_memory_bytes: memory,
    })
}

/// Numbers of members spread evenly over a design.
fn spread(members: u64) -> impl Iterator<Item = u64> {
    let count = members.min(COSTED);
    (0..count).map(move |place| place * members / count.max(1))
}

fn cost_of(scenario: &Value) -> Option<Cost> {
    let scenario = Scenario::from_value(scenario).ok()?;
    let prepared = PreparedScene::of(&scenario).ok()?;
    Some(Cost::of(&prepared))
}
