//! Schedule of a study: which members are to be computed next, and when it has ended.

use super::study::MemberCounts;
use scree_studies::answers::{RestDistribution, RestingPlaces};
use scree_studies::{Ensemble, Member, Progress, Question, Stop, Study, Verdict};
use std::collections::BTreeSet;
use std::ops::Range;

/// Next step of a study.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Next {
    /// Members of these numbers are to be computed, in this order.
    Members(Range<u64>),
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

/// Next step of a study whose first members have been made, so many of them with an outcome; at
/// most `most` members are in work at a time.
pub fn next(ensemble: &Ensemble, counts: MemberCounts, most: u64) -> Next {
    let in_work = counts.made - counts.ended;
    let until = ensemble
        .members()
        .min(counts.made + most.saturating_sub(in_work));
    if until > counts.made {
        Next::Members(counts.made..until)
    } else if in_work > 0 || counts.made < ensemble.members() {
        Next::Wait
    } else {
        Next::Conclude
    }
}

/// Conclusion from these outcomes of all members of a study.
pub fn conclusion(ensemble: &Ensemble, outcomes: &[Member]) -> Conclusion {
    let study = ensemble.study();
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
        let Conclusion::Enlarge(larger) = conclusion(&ensemble, &[]) else {
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
        assert_eq!(conclusion(&ensemble, &[]), Conclusion::End);
    }

    fn counts(made: u64, ended: u64) -> MemberCounts {
        MemberCounts { made, ended }
    }

    #[test]
    fn members_are_made_as_others_end_until_all_are() {
        let study = study(8);
        let ensemble = Ensemble::of(&study).unwrap();
        let next = |made, ended| next(&ensemble, counts(made, ended), 3);
        assert_eq!(next(0, 0), Next::Members(0..3));
        assert_eq!(next(3, 0), Next::Wait);
        assert_eq!(next(3, 2), Next::Members(3..5));
        assert_eq!(next(7, 7), Next::Members(7..8));
        assert_eq!(next(8, 7), Next::Wait);
        assert_eq!(next(8, 8), Next::Conclude);
    }

    #[test]
    fn without_a_stopping_rule_the_design_is_the_end() {
        let study = study(2);
        let ensemble = Ensemble::of(&study).unwrap();
        assert_eq!(conclusion(&ensemble, &[]), Conclusion::End);
    }
}
