//! Members and levels are added until a mean is as accurate as asked.

use super::{COARSEST_M, expectation, finished, quantity, runs, study};
use scree_studies::answers::AccuracyReached;
use scree_studies::{
    Accuracy, Answers, Ensemble, Forecast, ForecastLevel, Member, MemberOutcome, Needed, NextStep,
    Study,
};
use serde_json::json;

/// Study that begins with the coarsest level alone.
fn asked(seed: u64, target: f64) -> Study {
    let mut study = study([64, 16, 8], seed, &json!([]));
    study.finer_levels.clear();
    study.accuracy = Some(Accuracy {
        quantity: "y".to_owned(),
        body: None,
        target,
        finest_cell_size_m: None,
        budget_point_steps: 1e12,
    });
    study
}

fn outcomes(ensemble: &Ensemble) -> Vec<Member> {
    runs(ensemble, |u, cells| finished(quantity(u, cells), cells))
}

/// The study at its end, and the accuracy that it has reached.
fn ended(mut study: Study) -> (Study, AccuracyReached) {
    for _ in 0..40 {
        let ensemble = Ensemble::of(&study).unwrap();
        let members = outcomes(&ensemble);
        let next = NextStep::of(&ensemble, &members, |_| true).unwrap();
        let Some(larger) = next.study else {
            let reached = Answers::of(&ensemble, &members).accuracy.unwrap();
            return (study, reached);
        };
        assert_ne!(larger, study);
        study = larger;
    }
    panic!(
        "it does not end: {:?} {:?}",
        study.design, study.finer_levels
    );
}

#[test]
fn a_target_is_met_by_an_interval_that_holds_the_limit_of_fine_cells() {
    let mut held = 0;
    for seed in 0..60 {
        let (study, reached) = ended(asked(seed, 0.05));
        assert_eq!(reached.needed, Needed::Nothing);
        assert!(reached.reached.unwrap() <= 0.05, "{reached:?}");
        assert!(study.levels() >= 3, "{study:?}");
        let truth = expectation(0.0);
        let mean = reached.mean;
        held += usize::from(mean.lower.unwrap() <= truth && truth <= mean.upper.unwrap());
    }
    assert!(held >= 55, "{held} of 60");
}

#[test]
fn levels_are_cheaper_than_the_finest_alone() {
    let (_, reached) = ended(asked(1, 0.03));
    assert!(reached.gain.unwrap() > 5.0, "{reached:?}");
    assert_eq!(
        reached.levels.len(),
        ended(asked(1, 0.03)).0.levels() as usize
    );
}

#[test]
fn a_budget_is_kept() {
    let mut study = asked(1, 0.03);
    let (_, without) = ended(study.clone());
    if let Some(accuracy) = &mut study.accuracy {
        accuracy.budget_point_steps = 0.5 * without.point_steps;
    }
    let (_, reached) = ended(study);
    assert_eq!(reached.needed, Needed::Budget);
    assert!(reached.point_steps <= 0.5 * without.point_steps);
}

#[test]
fn cells_are_no_smaller_than_allowed() {
    let mut study = asked(1, 0.03);
    if let Some(accuracy) = &mut study.accuracy {
        accuracy.finest_cell_size_m = Some(0.4 * COARSEST_M);
    }
    let (study, reached) = ended(study);
    assert_eq!(reached.needed, Needed::SmallerCells);
    assert!(
        study
            .finer_levels
            .iter()
            .all(|level| level.cell_size_m >= 0.4 * COARSEST_M)
    );
}

#[test]
fn levels_all_of_whose_members_fail_are_the_end() {
    let study = study([64, 16, 8], 1, &json!([]));
    let study = Study {
        accuracy: asked(1, 0.05).accuracy,
        ..study
    };
    let ensemble = Ensemble::of(&study).unwrap();
    let mut members = outcomes(&ensemble);
    for member in members.iter_mut().filter(|member| member.level == 2) {
        member.outcome = MemberOutcome::failed("numerical");
    }
    let next = NextStep::of(&ensemble, &members, |_| true).unwrap();
    assert_eq!((next.needed, next.study), (Needed::Successes, None));
}

#[test]
fn a_quantity_that_never_varies_is_met_at_once() {
    let study = asked(1, 0.05);
    let constant = |study: &Study| {
        let ensemble = Ensemble::of(study).unwrap();
        let members = runs(&ensemble, |_, cells| finished(2.0, cells));
        NextStep::of(&ensemble, &members, |_| true).unwrap()
    };
    let two = constant(&study).study.unwrap();
    let three = constant(&two).study.unwrap();
    assert_eq!(three.levels(), 3);
    assert_eq!(constant(&three).needed, Needed::Nothing);
}

#[test]
fn a_forecast_takes_finer_cells_for_a_closer_target() {
    let forecast = |target: f64, finest_cell_size_m: Option<f64>| {
        let mut study = asked(1, target);
        if let Some(accuracy) = &mut study.accuracy {
            accuracy.finest_cell_size_m = finest_cell_size_m;
        }
        Forecast::of(&study, 1e6).unwrap()
    };
    let (wide, close) = (forecast(0.2, None), forecast(0.05, None));
    assert!(wide.levels.len() >= 3 && close.levels.len() > wide.levels.len());
    for one in [&wide, &close] {
        assert!(one.is_expected_to_be_met && one.gain > 1.0, "{one:?}");
        let work = |level: &ForecastLevel| level.members as f64 * level.point_steps_per_member;
        assert_eq!(one.point_steps, one.levels.iter().map(work).sum::<f64>());
        let alone = one.one_level_point_steps / one.point_steps;
        assert!((one.gain / alone - 1.0).abs() < 1e-12);
        let members: Vec<u64> = one.levels.iter().map(|level| level.members).collect();
        assert!(
            members.is_sorted_by(|coarse, fine| coarse >= fine),
            "{members:?}"
        );
    }
    assert!(!forecast(0.05, Some(0.01)).is_expected_to_be_met);
    let without = study([64, 16, 8], 1, &json!([]));
    assert_eq!(Forecast::of(&without, 1e6), None);
}

#[test]
fn outcomes_beyond_the_present_design_change_nothing() {
    let study = study([64, 16, 8], 1, &json!([]));
    let study = Study {
        accuracy: asked(1, 0.001).accuracy,
        ..study
    };
    let ensemble = Ensemble::of(&study).unwrap();
    let members = outcomes(&ensemble);
    let mut more = members.clone();
    for level in 0..3 {
        let index = 1000;
        let outcome = finished(1e3, 1e-3);
        more.push(Member {
            level,
            index,
            outcome,
        });
    }
    let next = |members: &[Member]| NextStep::of(&ensemble, members, |_| true);
    assert_eq!(next(&more), next(&members));
}

#[test]
fn a_finer_level_that_is_not_allowed_leaves_more_members_or_the_end() {
    let study = asked(1, 0.05);
    let ensemble = Ensemble::of(&study).unwrap();
    let next = NextStep::of(&ensemble, &outcomes(&ensemble), |_| false).unwrap();
    assert_eq!((next.needed, next.study), (Needed::FinerLevel, None));
}

#[test]
fn a_target_is_not_met_by_members_that_are_unknown() {
    let study = asked(1, 0.2);
    let (study, reached) = ended(study);
    assert_eq!(reached.needed, Needed::Nothing);
    let ensemble = Ensemble::of(&study).unwrap();
    let mut members = outcomes(&ensemble);
    for member in members.iter_mut().filter(|member| member.index % 2 == 1) {
        member.outcome = MemberOutcome::failed("numerical");
    }
    let reached = Answers::of(&ensemble, &members).accuracy.unwrap();
    assert!(reached.reached.unwrap() > 0.2, "{reached:?}");
    assert_ne!(reached.needed, Needed::Nothing);
}
