//! Plan of a study: what its members cost.

use super::members::scenario;
use scree_solver::plan::Cost;
use scree_solver::scenario::Scenario;
use scree_solver::simulation::PreparedScene;
use scree_studies::{Ensemble, Forecast, MemberId};
use serde::Serialize;
use serde_json::Value;
use utoipa::ToSchema;

/// Most members whose cost is found; of a larger study, members spread over the design stand for
/// the others.
const COSTED: u64 = 32;

/// Reader of a member's scenario; `None` where it is not allowed.
pub type ReadScenario<'a> = dyn Fn(&str) -> Option<Scenario> + 'a;

/// Cost of the members of a study.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
#[schema(as = StudyCost)]
pub struct StudyCost {
    /// Members of the design, on all levels together.
    pub members: u64,
    /// Most members, if a stopping rule enlarges the design; else those of the design.
    pub max_members: u64,
    /// Members whose cost was found; the others of a level are taken to cost as much on average.
    pub members_costed: u64,
    /// Mean work of a member [point-steps].
    pub point_steps_per_member: f64,
    /// Work of all members of the design [point-steps].
    pub point_steps: f64,
    /// Largest memory of a member [bytes].
    pub member_memory_bytes: u64,
    /// Levels that the accuracy asked for is expected to take, from studies of the source paper's
    /// scene; null without one. Members and levels are added by what the first ones tell.
    #[schema(required = true)]
    pub accuracy: Option<Forecast>,
}

/// Cost of a study; members that can't be set up are left out. `None` if those are all of a level.
pub fn cost(ensemble: &Ensemble, read: &ReadScenario) -> Option<StudyCost> {
    let study = ensemble.study();
    let levels: Vec<LevelCost> = (0..study.levels())
        .map(|level| LevelCost::of(ensemble, level, read))
        .collect::<Option<_>>()?;
    let (members, work) = (
        study.runs(),
        levels.iter().map(LevelCost::point_steps).sum(),
    );
    let most = study.stop.as_ref().map_or(0, |stop| stop.max_members);
    Some(StudyCost {
        members,
        max_members: most.max(members),
        members_costed: levels.iter().map(|level| level.costed).sum(),
        point_steps_per_member: work / members as f64,
        point_steps: work,
        member_memory_bytes: levels.iter().map(|level| level.memory_bytes).max()?,
        accuracy: Forecast::of(study, levels[0].point_steps_per_member),
    })
}

/// Cost of the members of a level.
struct LevelCost {
    members: u64,
    costed: u64,
    point_steps_per_member: f64,
    memory_bytes: u64,
}

impl LevelCost {
    fn of(ensemble: &Ensemble, level: u32, read: &ReadScenario) -> Option<Self> {
        let members = ensemble.study().members_on(level);
        let costs: Vec<Cost> = spread(members, COSTED / u64::from(ensemble.study().levels()))
            .filter_map(|index| cost_of(&scenario(ensemble, MemberId { level, index }).ok()?, read))
            .collect();
        let work: f64 = costs.iter().map(|cost| cost.point_steps as f64).sum();
        Some(Self {
            members,
            costed: costs.len() as u64,
            point_steps_per_member: work / costs.len() as f64,
            memory_bytes: costs.iter().map(|cost| cost.memory_bytes).max()?,
        })
    }

    fn point_steps(&self) -> f64 {
        self.members as f64 * self.point_steps_per_member
    }
}

/// At most so many numbers of members spread evenly over a level.
fn spread(members: u64, most: u64) -> impl Iterator<Item = u64> {
    let count = members.min(most);
    (0..count).map(move |place| place * members / count.max(1))
}

fn cost_of(scenario: &Value, read: &ReadScenario) -> Option<Cost> {
    let scenario = read(&scenario.to_string())?;
    let prepared = PreparedScene::of(&scenario).ok()?;
    Some(Cost::of(&prepared))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studies::questions;
    use scree_studies::Study;
    use std::path::Path;

    #[test]
    fn every_example_is_allowed_and_has_a_cost() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/studies");
        let examples: Vec<_> = std::fs::read_dir(folder).unwrap().collect();
        assert!(examples.len() >= 2);
        for example in examples {
            let path = example.unwrap().path();
            let text = std::fs::read_to_string(&path).unwrap();
            let study: Study = serde_json::from_str(&text).unwrap();
            assert_eq!(questions::violations(&study), [], "{}", path.display());
            let ensemble = Ensemble::of(&study).unwrap();
            for end in ensemble.end_scenarios() {
                Scenario::from_value(&end.scenario).unwrap();
            }
            let cost = cost(&ensemble, &|text| Scenario::from_json(text).ok()).unwrap();
            assert!(cost.point_steps > 0.0, "{}", path.display());
            assert_eq!(cost.accuracy.is_some(), study.accuracy.is_some());
        }
    }
}
