//! Schedule of a study: which members are to be computed next, and when it has ended.

use scree_studies::answers::{RestDistribution, RestingPlaces};
use scree_studies::{
    Ensemble, Member, MemberId, NextStep, Progress, Question, Stop, Study, Verdict,
};
use serde_json::Value;
use std::collections::BTreeSet;

/// Next step of a study.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Next {
    /// These members are to be computed, in this order.
    Members(Vec<MemberId>),
    /// The members in work are to end first.
    Wait,
    /// All members of the design have an outcome: see [`conclusion`].
    Conclude,
}

/// Conclusion from the outcomes of all members of a study.
#[derive(Debug, Clone, PartialEq)]
pub enum Conclusion {
    /// It goes on as this larger study.
    Enlarge(Box<Study>),
    /// It has ended.
    End,
}

/// Next step of a study whose first members on each level have been made, `in_work` of them without
/// an outcome; at most `most` members are in work at a time.
pub fn next(study: &Study, made: &[u64], (in_work, most): (u64, u64)) -> Next {
    let made_on = |level: u32| made.get(level as usize).copied().unwrap_or(0);
    let mut missing = study
        .ids()
        .filter(|id| id.index >= made_on(id.level))
        .peekable();
    let is_complete = missing.peek().is_none();
    let new: Vec<MemberId> = missing
        .take(most.saturating_sub(in_work) as usize)
        .collect();
    if !new.is_empty() {
        Next::Members(new)
    } else if in_work > 0 || !is_complete {
        Next::Wait
    } else {
        Next::Conclude
    }
}

/// Conclusion from these outcomes of all members of a study, where only such scenarios are allowed.
pub fn conclusion(
    ensemble: &Ensemble,
    outcomes: &[Member],
    is_allowed: impl Fn(&Value) -> bool,
) -> Conclusion {
    let study = ensemble.study();
    let finest_is_allowed = |study: &Study| finest_level_is_allowed(study, &is_allowed);
    if let Some(next) = NextStep::of(ensemble, outcomes, finest_is_allowed) {
        return next.study.map_or(Conclusion::End, |larger| {
            Conclusion::Enlarge(Box::new(larger))
        });
    }
    match (&study.stop, study.design.doubled()) {
        (Some(stop), Some(design)) if verdict(ensemble, stop, outcomes) == Verdict::Double => {
            let larger = Study {
                design,
                ..study.clone()
            };
            // A design may not grow beyond its own limits.
            match larger.violations().is_empty() {
                true => Conclusion::Enlarge(Box::new(larger)),
                false => Conclusion::End,
            }
        }
        _ => Conclusion::End,
    }
}

/// True if scenarios on the finest level are allowed: those at both ends of every input.
fn finest_level_is_allowed(study: &Study, is_allowed: impl Fn(&Value) -> bool) -> bool {
    let are_allowed = |ensemble: Ensemble| {
        let mut ends = ensemble.end_scenarios();
        ends.all(|end| is_allowed(&end.scenario))
    };
    Ensemble::of(study).is_ok_and(are_allowed)
}

/// Verdict of the stopping rule on a design all of whose members have an outcome.
fn verdict(ensemble: &Ensemble, stop: &Stop, outcomes: &[Member]) -> Verdict {
    let of_first = |members: u64| -> Vec<Member> {
        let first = outcomes.iter().filter(|member| member.index < members);
        first.cloned().collect()
    };
    // A former, larger design may have left more.
    let (first_half, all) = (
        of_first(ensemble.members() / 2),
        of_first(ensemble.members()),
    );
    let questions = ensemble.study().questions.iter();
    let watched: BTreeSet<usize> = questions
        .filter_map(|question| match question {
            Question::Rest(rest) if rest.regions.contains(&stop.region) => Some(rest.body),
            _ => None,
        })
        .collect();
    let area = |members: &[Member], body: usize| {
        let places = RestingPlaces::of(ensemble, members, body);
        let distribution = RestDistribution::of(&places, &[stop.region]);
        let region = distribution.regions.first();
        // Without a region nothing is settled.
        region.map_or(f64::NAN, |region| region.area_m2)
    };
    let areas_m2 = watched
        .into_iter()
        .map(|body| [area(&first_half, body), area(&all, body)])
        .collect();
    stop.verdict(&Progress {
        areas_m2,
        members: ensemble.members(),
        point_steps: point_steps(&all),
    })
}

/// Work of the members so far [point-steps].
fn point_steps(outcomes: &[Member]) -> f64 {
    let finished = outcomes.iter().filter_map(Member::finished);
    finished
        .filter_map(|finished| finished.quantity("point_steps", None))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;
    use std::ops::Range;

    fn study(members: u64) -> Study {
        let document = json!({
            "scenario": {"x": 0.0},
            "inputs": [{"pointer": "/x", "distribution": {"uniform": {"from": 0.0, "to": 1.0}}}],
            "design": {"sobol": {"members": members, "seed": 1}},
        });
        serde_json::from_value(document).unwrap()
    }

    fn stopping(members: u64) -> Study {
        let mut study = study(members);
        let rest = json!([{"rest": {"body": 0, "regions": [0.9]}}]);
        study.questions = serde_json::from_value(rest).unwrap();
        let stop = json!({"region": 0.9, "area_changes_less_than": 0.05, "max_members": 1_048_576});
        study.stop = serde_json::from_value(stop).unwrap();
        study
    }

    #[test]
    fn a_design_without_a_region_yet_is_doubled() {
        let study = stopping(8);
        let ensemble = Ensemble::of(&study).unwrap();
        let Conclusion::Enlarge(larger) = conclusion(&ensemble, &[], |_| true) else {
            panic!("it ended without a region");
        };
        assert_eq!(larger.members(), 16);
    }

    #[test]
    fn a_design_that_can_not_grow_any_more_is_the_end() {
        let study = Study {
            stop: None,
            ..stopping(1_048_576)
        };
        let ensemble = Ensemble::of(&study).unwrap();
        assert_eq!(conclusion(&ensemble, &[], |_| true), Conclusion::End);
    }

    #[test]
    fn members_are_made_as_others_end_until_all_are() {
        let study = study(8);
        let next = |made, ended| next(&study, &[made], (made - ended, 3));
        let numbers =
            |numbers: Range<u64>| Next::Members(numbers.map(MemberId::coarsest).collect());
        assert_eq!(next(0, 0), numbers(0..3));
        assert_eq!(next(3, 0), Next::Wait);
        assert_eq!(next(3, 2), numbers(3..5));
        assert_eq!(next(7, 7), numbers(7..8));
        assert_eq!(next(8, 7), Next::Wait);
        assert_eq!(next(8, 8), Next::Conclude);
    }

    #[test]
    fn members_of_fine_cells_are_made_first() {
        let mut study = study(16);
        study.scenario = json!({"x": 0.0, "numerics": {"cell_size_m": 0.03}});
        let finer = json!([{"cell_size_m": 0.02, "members": 8}]);
        study.finer_levels = serde_json::from_value(finer).unwrap();
        let on = |level, numbers: Range<u64>| numbers.map(move |index| MemberId { level, index });
        let next = |made: &[u64]| next(&study, made, (0, 6));
        assert_eq!(next(&[]), Next::Members(on(1, 0..6).collect()));
        let both = on(1, 6..8).chain(on(0, 2..6));
        assert_eq!(next(&[2, 6]), Next::Members(both.collect()));
        assert_eq!(next(&[16, 8]), Next::Conclude);
    }

    #[test]
    fn without_a_stopping_rule_the_design_is_the_end() {
        let study = study(2);
        let ensemble = Ensemble::of(&study).unwrap();
        assert_eq!(conclusion(&ensemble, &[], |_| true), Conclusion::End);
    }
}
