//! Convergence studies of made-up outcomes, so that their results are known.

use super::*;
use crate::record::Basis;
use serde_json::{Value, json};

/// A cube of 40 mm, cells of 10 mm, with this in its accuracy.
fn scenario(accuracy: &Value) -> Scenario {
    let mut document = json!({
        "channel": {"inclination_deg": 40, "incline_length_m": 1, "runout_length_m": 2},
        "flow": {"volume_m3": 0.004},
        "bodies": [{"shape": {"cube": {"side_m": 0.04}}}],
        "accuracy": accuracy
    });
    if accuracy["target"].is_null() {
        document["numerics"] = json!({"cell_size_m": 0.01});
    }
    Scenario::from_value(&document).unwrap()
}

/// Outcome of a run with such cells: a displacement of this many metres.
fn outcome(scenario: &Scenario, displacement_m: f64) -> Outcome {
    let cell_size_m = scenario.numerics.cell_size_m.unwrap();
    let document = json!({
        "bodies": [{"onset_time_s": 0.2, "peak_speed_m_s": 1.0, "peak_speed_time_s": 0.3,
                    "stop_time_s": null, "displacement_m": displacement_m,
                    "path_length_m": displacement_m, "final_position_m": [0.4, 0.0, 0.02],
                    "final_orientation": [1.0, 0.0, 0.0, 0.0], "error_bars": null,
                    "mass_properties": {"mass_kg": 0.1, "volume_m3": 6e-5,
                                        "principal_moments_kg_m2": [1e-5, 1e-5, 1e-5],
                                        "principal_axes": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0],
                                                           [0.0, 0.0, 1.0]]}}],
        "flow": {"front_m": 1.0, "runout_m": 1.0, "outflow_mass_kg": 0.0,
                 "excluded_volume_m3": 0.0, "error_bars": null},
        "conservation": {"mass_error": 0.0, "momentum_residual": 0.0, "angular_momentum_residual": 0.0,
                  "angular_momentum_from_shifting": 0.0, "energy_residual": 0.0,
                  "max_overlap_ratio": 0.0, "max_body_overlap_ratio": 0.0,
                  "penetration_corrections": 0, "points_outflow": 0, "points_lost": 0},
        "cost": {"points": 1, "steps": 1, "substeps": 1, "wall_s": 1.0, "point_steps_per_s": 1.0,
                 "point_steps": (1e9 * (0.01 / cell_size_m).powi(4)) as u64, "threads": 1,
                 "cell_size_m": cell_size_m, "sound_speed_m_s": 20.0},
        "ended_early": null, "plan": null, "accuracy": null
    });
    serde_json::from_value(document).unwrap()
}

/// Carries out a convergence study whose displacement follows the cell size by this function.
fn carried_out(accuracy: &Value, displacement_m: fn(f64) -> f64) -> Outcome {
    let mut convergence_study = ConvergenceStudy::of(&scenario(accuracy)).unwrap();
    let mut runs = 0;
    while let Some(study_run) = convergence_study.next() {
        let scenario = convergence_study.scenario_of(study_run);
        convergence_study.take(Ok(outcome(
            &scenario,
            displacement_m(study_run.cell_size_m),
        )));
        runs += 1;
        assert!(runs < 30, "it ends");
    }
    convergence_study.finish().unwrap()
}

fn linear(cell_size_m: f64) -> f64 {
    0.4 + 4.0 * cell_size_m
}

#[test]
fn a_plain_answer_is_one_run_of_the_scenario_as_it_stands() {
    let given = scenario(&json!({}));
    let convergence_study = ConvergenceStudy::of(&given).unwrap();
    let study_run = convergence_study.next().unwrap();
    assert_eq!(convergence_study.scenario_of(study_run), given);
    assert!(
        convergence_study.may_be_the_answer(study_run)
            && !convergence_study.can_do_without(study_run)
    );
    let answer = carried_out(&json!({}), linear);
    assert_eq!(answer, outcome(&given, linear(0.01)));
}

#[test]
fn refinement_runs_are_coarser_and_cost_a_third_at_most() {
    let given = scenario(&json!({"error_bars": true}));
    let mut convergence_study = ConvergenceStudy::of(&given).unwrap();
    let mut roles = Vec::new();
    while let Some(study_run) = convergence_study.next() {
        let scenario = convergence_study.scenario_of(study_run);
        let sound_speed = scenario.numerics.sound_speed_m_s;
        match study_run.role {
            Role::Answer => assert_eq!(scenario, given),
            role => {
                assert!(study_run.cell_size_m > 0.0149, "{study_run:?}");
                assert_eq!(scenario.flow_snapshots, 0);
                assert!(!scenario.accuracy.is_asked_for());
                assert_eq!(sound_speed.is_some(), role == Role::ReducedStiffness);
            }
        }
        roles.push(study_run.role);
        convergence_study.take(Ok(outcome(&scenario, linear(study_run.cell_size_m))));
    }
    assert_eq!(roles.last(), Some(&Role::Answer));
    assert!(roles.contains(&Role::ReducedStiffness));
    let report = convergence_study.finish().unwrap().accuracy.unwrap();
    assert!(report.extra_cost < 0.35, "{report:?}");
    assert_eq!(report.runs.len(), roles.len());
    let cells = report.runs.last().unwrap().cells_per_body.unwrap();
    assert!((cells - 4.0).abs() < 1e-9, "{cells}");
}

#[test]
fn the_answer_keeps_its_values_and_gets_bands_round_them() {
    let answer = carried_out(&json!({"error_bars": true}), linear);
    let body = &answer.bodies[0];
    let bars = body.error_bars.as_ref().unwrap();
    assert_eq!(bars.displacement_m.value, Some(body.displacement_m));
    assert_eq!(body.displacement_m, linear(0.01));
    assert_eq!(bars.displacement_m.basis, Basis::Converging);
    assert!(bars.displacement_m.low.unwrap() <= linear(0.0));
    assert!(bars.displacement_m.high.unwrap() > linear(0.01));
    assert_eq!(bars.stop_time_s.basis, Basis::NeverHappened);
    assert_eq!(bars.final_position_m[2].value, Some(0.02));
    assert!(answer.flow.error_bars.is_some());
}

#[test]
fn a_stiffness_that_is_given_is_not_varied() {
    let mut given = scenario(&json!({"error_bars": true}));
    given.flow.as_mut().unwrap().material.youngs_modulus_pa = Some(1e6);
    let convergence_study = ConvergenceStudy::of(&given).unwrap();
    assert!(
        convergence_study
            .to_do
            .iter()
            .all(|study_run| study_run.role != Role::ReducedStiffness)
    );
}

#[test]
fn cells_much_larger_than_a_body_are_not_run() {
    let mut given = scenario(&json!({"error_bars": true}));
    // 1.33 cells across the cube, and 0.67 twice as coarse.
    given.numerics.cell_size_m = Some(0.03);
    let convergence_study = ConvergenceStudy::of(&given).unwrap();
    let sizes: Vec<f64> = convergence_study
        .to_do
        .iter()
        .map(|study_run| study_run.cell_size_m)
        .collect();
    assert!(sizes.iter().all(|size| *size <= 0.04 / 0.75), "{sizes:?}");
    assert!(sizes.len() >= 2, "an answer is never alone: {sizes:?}");
}

#[test]
fn a_refinement_run_that_fails_is_left_out_and_named() {
    let given = scenario(&json!({"error_bars": true}));
    let mut convergence_study = ConvergenceStudy::of(&given).unwrap();
    let first = convergence_study.next().unwrap();
    assert!(convergence_study.can_do_without(first));
    convergence_study.take(Err("it blew up".to_owned()));
    while let Some(study_run) = convergence_study.next() {
        let scenario = convergence_study.scenario_of(study_run);
        convergence_study.take(Ok(outcome(&scenario, linear(study_run.cell_size_m))));
    }
    let report = convergence_study.finish().unwrap().accuracy.unwrap();
    assert_eq!(report.runs[0].failure.as_deref(), Some("it blew up"));
    assert_eq!(
        (report.runs[0].point_steps, report.runs[0].wall_s),
        (None, None)
    );
}

#[test]
fn a_target_is_met_by_cells_no_finer_than_it_takes() {
    let reach = |target: f64| {
        let answer = carried_out(
            &json!({"target": target, "quantity": "displacement_m"}),
            linear,
        );
        let report = answer.accuracy.clone().unwrap();
        let verdict = report.target.unwrap();
        assert!(verdict.met && verdict.reason.is_none(), "{verdict:?}");
        assert!(verdict.reached.unwrap() <= target, "{verdict:?}");
        // The grid-converged value is within the target, too.
        assert!((answer.bodies[0].displacement_m - 0.4).abs() <= target * 0.45);
        assert_eq!(verdict.body, Some(0));
        answer.cost.cell_size_m
    };
    let (rough, fine) = (reach(0.5), reach(0.1));
    assert!(fine < 0.5 * rough, "{fine} {rough}");
    assert!(fine > 0.003, "{fine}");
}

#[test]
fn runs_far_coarser_than_the_answer_do_not_widen_its_band() {
    // Nonsense with cells that are too coarse, regular with finer ones.
    let settles = |cell_size_m: f64| {
        let nonsense = if cell_size_m > 0.02 {
            20.0 * (cell_size_m * 1e3).sin()
        } else {
            0.0
        };
        0.4 + 4.0 * cell_size_m + nonsense
    };
    let answer = carried_out(
        &json!({"target": 0.2, "quantity": "displacement_m"}),
        settles,
    );
    let report = answer.accuracy.unwrap();
    assert!(report.target.unwrap().met);
    let answers = report.runs.iter().filter(|run| run.cell_size_m < 0.01);
    assert!(answers.count() < 6, "{:?}", report.runs);
}

#[test]
fn a_target_beyond_the_budget_says_so_and_answers_all_the_same() {
    let accuracy = json!({"target": 0.01, "quantity": "displacement_m",
                          "budget_point_steps": 3e9});
    let answer = carried_out(&accuracy, linear);
    let report = answer.accuracy.as_ref().unwrap();
    let spent: u64 = report.runs.iter().filter_map(|run| run.point_steps).sum();
    assert!(spent as f64 <= 3e9 && spent > 1_000_000_000, "{spent}");
    let verdict = report.target.as_ref().unwrap();
    assert!(!verdict.met && verdict.reached > Some(0.01));
    let reason = verdict.reason.as_ref().unwrap();
    assert!(reason.contains("budget_point_steps"), "{reason}");
    assert_eq!(report.runs.last().unwrap().role, Role::Answer);
}

#[test]
fn every_run_that_may_become_the_answer_is_recorded_in_full() {
    let given = scenario(&json!({"target": 0.1, "quantity": "displacement_m"}));
    let convergence_study = ConvergenceStudy::of(&given).unwrap();
    for study_run in &convergence_study.to_do {
        let scenario = convergence_study.scenario_of(*study_run);
        let whole = study_run.role != Role::ReducedStiffness;
        assert_eq!(scenario.flow_snapshots == given.flow_snapshots, whole);
        assert_eq!(convergence_study.may_be_the_answer(*study_run), whole);
    }
}

#[test]
fn a_target_about_what_never_happens_is_given_up() {
    let accuracy = json!({"target": 0.05, "quantity": "stop_time_s"});
    let verdict = carried_out(&accuracy, linear)
        .accuracy
        .unwrap()
        .target
        .unwrap();
    assert!(!verdict.met);
    assert!(verdict.reason.unwrap().contains("did not happen"));
}

#[test]
fn softness_beyond_the_target_is_not_met_by_finer_cells() {
    let accuracy = json!({"target": 0.05, "quantity": "displacement_m"});
    let mut convergence_study = ConvergenceStudy::of(&scenario(&accuracy)).unwrap();
    let mut runs = 0;
    while let Some(study_run) = convergence_study.next() {
        let reduced_stiffness = if study_run.role == Role::ReducedStiffness {
            0.1
        } else {
            0.0
        };
        let scenario = convergence_study.scenario_of(study_run);
        convergence_study.take(Ok(outcome(
            &scenario,
            linear(study_run.cell_size_m) + reduced_stiffness,
        )));
        runs += 1;
    }
    assert!(runs < 9, "{runs} runs");
    let report = convergence_study.finish().unwrap().accuracy.unwrap();
    // Once more with finer cells, since the first are so coarse.
    let reduced_stiffness = report
        .runs
        .iter()
        .filter(|run| run.role == Role::ReducedStiffness);
    assert_eq!(reduced_stiffness.count(), 2, "{:?}", report.runs);
    let verdict = report.target.unwrap();
    assert!(!verdict.met);
    let reason = verdict.reason.unwrap();
    assert!(reason.contains("sound_speed_m_s"), "{reason}");
}

/// Values that keep changing direction, so that a target takes many runs.
fn turning(cell_size_m: f64) -> f64 {
    0.4 + 4.0 * cell_size_m + 0.2 * cell_size_m * (1e3 * cell_size_m).sin()
}

#[test]
fn a_target_makes_no_run_twice() {
    for displacement_m in [linear, turning] {
        for target in [0.5, 0.2, 0.1, 0.05] {
            let accuracy = json!({"target": target, "quantity": "displacement_m",
                                  "budget_point_steps": 1e13});
            let report = carried_out(&accuracy, displacement_m).accuracy.unwrap();
            let sizes = |reduced_stiffness: bool| -> Vec<f64> {
                let runs = report.runs.iter();
                let mut sizes: Vec<f64> = runs
                    .filter(|run| (run.role == Role::ReducedStiffness) == reduced_stiffness)
                    .map(|run| run.cell_size_m)
                    .collect();
                sizes.sort_by(f64::total_cmp);
                sizes
            };
            let ratio = |sizes: &[f64]| -> f64 {
                let ratios = sizes.windows(2).map(|pair| pair[1] / pair[0]);
                ratios.fold(f64::INFINITY, f64::min)
            };
            let (grids, reduced_stiffness) = (sizes(false), sizes(true));
            assert!(ratio(&grids) > 1.05, "{target}: {grids:?}");
            assert!(
                ratio(&reduced_stiffness) > 1.25,
                "{target}: {reduced_stiffness:?}"
            );
        }
    }
}

#[test]
fn every_answer_of_a_target_has_refinement_runs_in_the_useful_range() {
    let accuracy = json!({"target": 0.05, "quantity": "displacement_m",
                          "budget_point_steps": 1e13});
    let report = carried_out(&accuracy, linear).accuracy.unwrap();
    let grids = || {
        report
            .runs
            .iter()
            .filter(|run| run.role != Role::ReducedStiffness)
    };
    let finest = grids()
        .map(|run| run.cell_size_m)
        .fold(f64::INFINITY, f64::min);
    let ratios = grids().map(|run| run.cell_size_m / finest);
    let near = ratios.filter(|ratio| (1.2..=FARTHEST).contains(ratio));
    assert!(near.count() >= FEWEST_NEAR, "{:?}", report.runs);
}

#[test]
fn what_refinement_runs_cost_is_told_by_wall_time_too() {
    let answer = carried_out(&json!({"error_bars": true}), linear);
    let report = answer.accuracy.unwrap();
    // Every made-up run took a second.
    assert_eq!(report.extra_wall_cost, Some(3.0), "{:?}", report.runs);
}
