//! Counts, probabilities and quantiles.

use crate::support::{document, independent, members, numbers, rested, study, unit_study, z};
use scree_studies::answers::{Answer, Failures, Probability, Quantile, Sample};
use scree_studies::{Answers, Ensemble, Member, MemberOutcome};
use serde_json::json;

fn failed(index: u64, reason: &str) -> Member {
    let reason = reason.to_owned();
    Member {
        level: 0,
        index,
        outcome: MemberOutcome::failed(reason),
    }
}

#[test]
fn quantiles_are_those_of_type_8() {
    let sample = Sample {
        values: vec![5.0, 1.0, 2.0, 9.0],
        unknown: 0,
        levels: None,
    };
    // Places (4 + 1/3) p + 1/3 of 1, 2, 5, 9.
    let expected = [
        (0.5, 3.5),
        (0.25, 1.0 + 5.0 / 12.0),
        (0.9, 9.0),
        (0.05, 1.0),
    ];
    for (probability, value) in expected {
        let found = Quantile::of(&sample, probability).estimate.unwrap();
        assert!((found - value).abs() < 1e-12, "{probability}: {found}");
    }
}

#[test]
fn bounds_of_quantiles_hold_as_often_as_told() {
    let holds = |seed: u64| {
        let drawn = independent(60, 1, seed);
        let values = drawn.iter().map(|u| z(u[0]).exp()).collect();
        let found = Quantile::of(
            &Sample {
                values,
                unknown: 0,
                levels: None,
            },
            0.8,
        );
        let truth = z(0.8).exp();
        found.lower.unwrap() <= truth && truth <= found.upper.unwrap()
    };
    let held = (0..1000).filter(|seed| holds(*seed)).count();
    // At least 95 %, up to the error of a thousand trials; the steps of the binomial distribution
    // leave it below 99 %.
    assert!((936..990).contains(&held), "{held}");
}

#[test]
fn members_of_unknown_outcome_widen_quantiles_to_both_sides() {
    let values: Vec<f64> = (0..100).map(f64::from).collect();
    let known = Quantile::of(
        &Sample {
            values: values.clone(),
            unknown: 0,
            levels: None,
        },
        0.5,
    );
    let some = Quantile::of(
        &Sample {
            values: values.clone(),
            unknown: 10,
            levels: None,
        },
        0.5,
    );
    assert_eq!(known.estimate, some.estimate);
    assert_eq!((known.lower, known.upper), (Some(39.0), Some(60.0)));
    // Ranks 45 and 66 of 110, less ten for the lower bound.
    assert_eq!((some.lower, some.upper), (Some(34.0), Some(65.0)));
    let most = Quantile::of(
        &Sample {
            values,
            unknown: 90,
            levels: None,
        },
        0.5,
    );
    assert_eq!((most.lower, most.upper), (None, None));
    let none = Quantile::of(&Sample::default(), 0.5);
    assert_eq!((none.estimate, none.lower, none.upper), (None, None, None));
}

#[test]
fn bounds_of_probabilities_hold_as_often_as_told() {
    let holds = |seed: u64| {
        let drawn = independent(50, 1, seed);
        let happened = drawn.iter().filter(|u| u[0] < 0.1).count() as u64;
        let found = Probability::of(happened, 50, 0);
        found.lower <= 0.1 && 0.1 <= found.upper
    };
    let held = (0..1000).filter(|seed| holds(*seed)).count();
    assert!((936..990).contains(&held), "{held}");
}

#[test]
fn members_of_unknown_outcome_widen_probabilities_to_both_sides() {
    let (all, known) = (Probability::of(30, 100, 0), Probability::of(30, 100, 20));
    assert_eq!((all.estimate, known.estimate), (Some(0.3), Some(0.3)));
    assert_eq!(known.lower, Probability::of(30, 120, 0).lower);
    assert_eq!(known.upper, Probability::of(50, 120, 0).upper);
    assert!(known.lower < all.lower && known.upper > all.upper);
    let none = Probability::of(0, 0, 5);
    assert_eq!((none.estimate, none.lower, none.upper), (None, 0.0, 1.0));
}

#[test]
fn every_question_of_a_study_is_answered_in_its_order() {
    let study = study(&document());
    let ensemble = Ensemble::of(&study).unwrap();
    let member = |index: u64| {
        let values = numbers(&ensemble, index);
        let mut outcome = rested([values[0], values[2] / 90.0], values[1]);
        if let MemberOutcome::Finished(finished) = &mut outcome {
            finished
                .quantities
                .insert("runout_m".to_owned(), 2.0 * values[0]);
            let quantities = &mut finished.bodies[0].quantities;
            quantities.insert("displacement_m".to_owned(), values[2] / 90.0);
        }
        Member::coarsest(index, outcome)
    };
    let mut members: Vec<Member> = (0..250).map(member).collect();
    members[3] = failed(3, "diverged");
    members[5] = failed(5, "out of memory");
    members[8] = failed(8, "diverged");
    members[9].outcome = MemberOutcome::Pending;
    let found = Answers::of(&ensemble, &members);
    members.reverse();
    assert_eq!(found, Answers::of(&ensemble, &members));

    let counts = &found.members;
    assert_eq!(
        (counts.finished, counts.failed, counts.pending),
        (246, 3, 7)
    );
    let failures = [("diverged", 2), ("out of memory", 1)].map(|(reason, members)| Failures {
        reason: reason.to_owned(),
        members,
    });
    assert_eq!(counts.failures, failures);

    let [
        Answer::Rest(rest),
        Answer::Exceeds(curve),
        Answer::Buried(buried),
        Answer::Quantiles(quantiles),
        Answer::Sensitivity(Some(_)),
    ] = &found.answers[..]
    else {
        panic!("{:?}", found.answers);
    };
    assert_eq!(rest.regions.len(), 4);
    assert_eq!(rest.regions[2].members.unknown, 10);
    let above: Vec<f64> = curve
        .iter()
        .map(|one| one.probability.estimate.unwrap())
        .collect();
    assert!(
        (above[0] - 0.8).abs() < 0.01 && (above[1] - 0.6).abs() < 0.01,
        "{above:?}"
    );
    assert_eq!(curve[1].threshold, 0.4);
    assert_eq!((buried.known, buried.unknown), (246, 10));
    assert!(buried.upper > 0.0 && buried.estimate == Some(0.0));
    let median = quantiles[0].estimate.unwrap();
    assert!((median - 0.75).abs() < 0.01, "{median}");
    let text = serde_json::to_string(&found).unwrap();
    assert_eq!(serde_json::from_str::<Answers>(&text).unwrap(), found);
}

#[test]
fn a_quantity_that_is_missing_or_not_finite_is_unknown() {
    let design = json!({"sobol": {"members": 8, "seed": 1}});
    let asked = json!([{"exceeds": {"quantity": "y", "thresholds": [0.0]}}]);
    let study = unit_study(1, &design, &asked);
    let ensemble = Ensemble::of(&study).unwrap();
    let mut members = members(&ensemble, |u| if u[0] < 0.25 { f64::NAN } else { u[0] });
    if let MemberOutcome::Finished(finished) = &mut members[0].outcome {
        finished.quantities.clear();
    }
    let missing = usize::from(numbers(&ensemble, 0)[0] >= 0.25);
    let sample = Sample::of(&ensemble, &members, "y", None);
    assert_eq!(sample.unknown as usize, 2 + missing);
    assert_eq!(sample.values.len(), 6 - missing);
    assert_eq!(Sample::of(&ensemble, &members, "y", Some(0)).unknown, 8);
}

#[test]
fn a_saltelli_design_counts_its_base_samples_alone() {
    let design = json!({"saltelli": {"base_members": 32, "seed": 1}});
    let study = unit_study(3, &design, &json!([]));
    let ensemble = Ensemble::of(&study).unwrap();
    let members = members(&ensemble, |u| u[0]);
    let sample = Sample::of(&ensemble, &members, "y", None);
    assert_eq!((sample.values.len(), sample.unknown), (64, 0));
    let few = Sample::of(&ensemble, &members[..7], "y", None);
    assert_eq!((few.values.len(), few.unknown), (4, 60));
}

#[test]
fn a_body_has_its_named_quantities() {
    let MemberOutcome::Finished(finished) = rested([1.5, -0.5], 0.02) else {
        panic!("not finished");
    };
    let found = ["rest_x_m", "rest_y_m", "rest_z_m", "buried_m"]
        .map(|name| finished.quantity(name, Some(0)));
    assert_eq!(found, [Some(1.5), Some(-0.5), Some(0.0), Some(0.02)]);
    assert_eq!(finished.quantity("hit", Some(0)), Some(1.0));
    assert_eq!(finished.quantity("moving", Some(0)), Some(0.0));
    assert_eq!(finished.quantity("rest_x_m", None), None);
    assert_eq!(finished.quantity("rest_x_m", Some(1)), None);
}
