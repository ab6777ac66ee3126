//! Bounds of multilevel estimates hold what they are about.

use super::{expectation, finished, quantity, runs, study};
use crate::support::{independent, mean};
use scree_studies::answers::{Answer, Mean};
use scree_studies::{Answers, Ensemble, Member, MemberOutcome};
use serde_json::{Value, json};

const MEMBERS: [u64; 3] = [256, 48, 16];
const FINEST_M: f64 = 0.015;
const STUDIES: u64 = 150;

/// Answers of many studies to the same questions.
fn answers(questions: &[Value]) -> Vec<Vec<Answer>> {
    let of_one = |seed| {
        let study = study(MEMBERS, seed, &json!(questions));
        let ensemble = Ensemble::of(&study).unwrap();
        let members = runs(&ensemble, |u, cells| finished(quantity(u, cells), cells));
        Answers::of(&ensemble, &members).answers
    };
    (0..STUDIES).map(of_one).collect()
}

/// Share of the studies for whose answer to the question at a place something holds.
fn share(answers: &[Vec<Answer>], place: usize, holds: impl Fn(&Answer) -> bool) -> f64 {
    let held = answers.iter().filter(|answers| holds(&answers[place]));
    held.count() as f64 / STUDIES as f64
}

fn mean_of(answer: &Answer) -> &Mean {
    match answer {
        Answer::Mean(mean) => mean,
        other => panic!("{other:?}"),
    }
}

fn bounds(answer: &Answer) -> [f64; 2] {
    match answer {
        Answer::Exceeds(curve) => [curve[0].probability.lower, curve[0].probability.upper],
        Answer::Quantiles(found) => [found[0].lower.unwrap(), found[0].upper.unwrap()],
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_mean_is_that_of_the_finest_level_and_its_interval_holds_the_limit() {
    let answers = answers(&[json!({"mean": {"quantity": "y"}})]);
    let average = |of: fn(&Mean) -> Option<f64>| {
        let values = answers
            .iter()
            .map(|answers| of(mean_of(&answers[0])).unwrap());
        mean(&values.collect::<Vec<f64>>())
    };
    let on_finest = expectation(FINEST_M);
    let estimate = average(|mean| mean.estimate);
    assert!(
        (estimate - on_finest).abs() < 0.005,
        "{estimate} {on_finest}"
    );
    let held = share(&answers, 0, |answer| {
        let found = mean_of(answer);
        let off = (found.estimate.unwrap() - on_finest).abs();
        off <= found.sampling_error.unwrap()
    });
    assert!(held >= 0.93, "{held}");
    // As many members on the finest level as on the coarsest would have this error; the few
    // pairs may cost at most half as much again.
    let sampling = average(|mean| mean.sampling_error);
    let all_finest = 1.96 * 0.5 / 256_f64.sqrt();
    assert!(sampling < 1.5 * all_finest, "{sampling} {all_finest}");
    let limit = expectation(0.0);
    let held = share(&answers, 0, |answer| {
        let found = mean_of(answer);
        found.lower.unwrap() <= limit && limit <= found.upper.unwrap()
    });
    assert!(held >= 0.95, "{held}");
    // Cells of the finest level are off by 0.15.
    let numerical = average(|mean| mean.numerical_error);
    assert!((0.15..0.35).contains(&numerical), "{numerical}");
}

#[test]
fn bounds_of_probabilities_and_quantiles_hold_those_of_the_finest_level() {
    let exact = independent(100_000, 4, 777);
    let mut values: Vec<f64> = exact.iter().map(|u| quantity(u, FINEST_M)).collect();
    values.sort_by(f64::total_cmp);
    let asked = [0.05, 0.5, 0.9].map(|probability| {
        (
            probability,
            values[(probability * values.len() as f64) as usize],
        )
    });
    let questions = asked.iter().flat_map(|(probability, quantile)| {
        [
            json!({"exceeds": {"quantity": "y", "thresholds": [quantile]}}),
            json!({"quantiles": {"quantity": "y", "probabilities": [probability]}}),
        ]
    });
    let answers = answers(&questions.collect::<Vec<Value>>());
    let truths = asked
        .iter()
        .flat_map(|(probability, quantile)| [1.0 - probability, *quantile]);
    for (place, truth) in truths.enumerate() {
        let held = share(&answers, place, |answer| {
            let [lower, upper] = bounds(answer);
            lower <= truth && truth <= upper
        });
        assert!(held >= 0.93, "{place}: {held}");
    }
}

#[test]
fn coarse_members_alone_answer_for_their_own_level() {
    let study = study(MEMBERS, 1, &json!([{"mean": {"quantity": "y"}}]));
    let ensemble = Ensemble::of(&study).unwrap();
    let all = runs(&ensemble, |u, cells| finished(quantity(u, cells), cells));
    let coarse: Vec<Member> = all.into_iter().filter(|member| member.level == 0).collect();
    let answers = Answers::of(&ensemble, &coarse);
    let Answer::Mean(mean) = &answers.answers[0] else {
        panic!("{answers:?}");
    };
    assert_eq!(mean.numerical_error, None);
    assert!((mean.estimate.unwrap() - expectation(super::COARSEST_M)).abs() < 0.05);
    assert_eq!(
        (answers.members.finished, answers.members.pending),
        (256, 64)
    );
}

#[test]
fn a_member_that_failed_on_its_finest_level_is_unknown_and_so_are_its_like() {
    let study = study(
        MEMBERS,
        1,
        &json!([{"exceeds": {"quantity": "y", "thresholds": [0.0]}}]),
    );
    let ensemble = Ensemble::of(&study).unwrap();
    let mut members = runs(&ensemble, |u, cells| finished(quantity(u, cells), cells));
    let on_finest = members
        .iter_mut()
        .find(|member| member.level == 2 && member.index == 3);
    on_finest.unwrap().outcome = MemberOutcome::failed("numerical");
    let answers = Answers::of(&ensemble, &members);
    let Answer::Exceeds(curve) = &answers.answers[0] else {
        panic!("{answers:?}");
    };
    let found = curve[0].probability;
    assert_eq!((found.known + found.unknown, found.upper), (256, 1.0));
    // One of sixteen.
    assert!((2..40).contains(&found.unknown), "{found:?}");
    let all_known = Ensemble::of(&study).unwrap();
    let all = runs(&all_known, |u, cells| finished(quantity(u, cells), cells));
    let Answer::Exceeds(whole) = &Answers::of(&all_known, &all).answers[0] else {
        panic!("no curve");
    };
    assert!(
        found.lower < whole[0].probability.lower,
        "{found:?} {whole:?}"
    );
}

#[test]
fn runs_that_fail_on_a_finer_level_count_for_all_members() {
    let study = study(
        MEMBERS,
        1,
        &json!([{"exceeds": {"quantity": "y", "thresholds": [0.0]}}]),
    );
    let ensemble = Ensemble::of(&study).unwrap();
    let members = runs(&ensemble, |u, cells| match cells < 0.03 && u[1] < 0.25 {
        true => MemberOutcome::failed("numerical"),
        false => finished(quantity(u, cells), cells),
    });
    let Answer::Exceeds(curve) = &Answers::of(&ensemble, &members).answers[0] else {
        panic!("no curve");
    };
    let unknown = curve[0].probability.unknown as f64 / 256.0;
    assert!((0.18..0.45).contains(&unknown), "{unknown}");
}

#[test]
fn what_many_members_share_exactly_is_drawn_from_all_pairs_that_have_it() {
    let questions = json!([{"exceeds": {"quantity": "y", "thresholds": [0.0]}}]);
    let study = study([256, 64, 64], 1, &questions);
    let ensemble = Ensemble::of(&study).unwrap();
    // Nothing happens in coarse cells, and something in half of the runs in finer ones, first in
    // few of them.
    let members = runs(&ensemble, |u, cells| match cells < 0.03 && u[0] > 0.5 {
        true => finished(1.0, cells),
        false => finished(0.0, cells),
    });
    let Answer::Exceeds(curve) = &Answers::of(&ensemble, &members).answers[0] else {
        panic!("no curve");
    };
    let found = curve[0].probability;
    assert!((0.4..0.6).contains(&found.estimate.unwrap()), "{found:?}");
    assert!(found.lower > 0.2 && found.upper < 0.8, "{found:?}");
}
