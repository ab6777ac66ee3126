//! Answers that need several runs.

use crate::app::{TestApp, tiny_scene};
use scree::runs::{Progress, RunControl, RunEnd, RunError, Sink, convergence_study};
use scree_solver::record::{Outcome, Record, Role, Sample};
use scree_solver::scenario::Scenario;
use serde_json::{Value, json};

/// Keeps samples and progress; raises a flag after a number of progress reports.
#[derive(Default)]
struct Recording {
    samples: Vec<Sample>,
    told: Vec<f64>,
}

impl Sink for Recording {
    type Error = &'static str;

    fn record(&mut self, record: Record) -> Result<(), Self::Error> {
        if let Record::Sample(sample) = record {
            self.samples.push(sample);
        }
        Ok(())
    }

    fn progress(&mut self, progress: &Progress) -> Result<(), Self::Error> {
        self.told.push(progress.fraction);
        Ok(())
    }
}

fn scene(accuracy: Value) -> Scenario {
    let mut scene = tiny_scene();
    if !accuracy["target"].is_null() {
        scene["numerics"] = json!({"points_per_cell": 4});
    }
    scene["accuracy"] = accuracy;
    Scenario::from_json(&scene.to_string()).unwrap()
}

fn completed(scenario: &Scenario) -> (Outcome, Recording) {
    let mut recording = Recording::default();
    match convergence_study::run(scenario, 1, &RunControl::default(), &mut recording) {
        Ok(RunEnd::Completed(outcome)) => (*outcome, recording),
        other => panic!("{other:?}"),
    }
}

/// The outcome without intervals and wall times.
fn bare(mut outcome: Outcome) -> Outcome {
    outcome.accuracy = None;
    outcome.flow.error_bars = None;
    for body in &mut outcome.bodies {
        body.error_bars = None;
    }
    outcome.cost.wall_s = 0.0;
    outcome.cost.point_steps_per_s = 0.0;
    outcome
}

#[test]
fn error_bars_change_no_bit_of_the_answer() {
    let (plain, its) = completed(&scene(json!({})));
    let (barred, also) = completed(&scene(json!({"error_bars": true})));
    assert!(plain.accuracy.is_none() && plain.bodies[0].error_bars.is_none());
    assert!(barred.bodies[0].error_bars.is_some() && barred.flow.error_bars.is_some());
    assert_eq!(its.samples, also.samples, "only the answer is recorded");
    assert_eq!(bare(plain), bare(barred));
}

#[test]
fn progress_is_that_of_all_runs_together() {
    let (_, recording) = completed(&scene(json!({"error_bars": true})));
    assert!(recording.told.is_sorted(), "{:?}", recording.told);
    assert_eq!(recording.told.last(), Some(&1.0));
    assert!(
        recording.told.len() >= 3,
        "a coarser run, the reduced-stiffness run, the answer"
    );
    assert!(recording.told[0] < 0.5, "{:?}", recording.told);
}

#[test]
fn a_stop_in_a_refinement_run_ends_everything() {
    let stop = RunControl::default();
    stop.raise();
    let mut recording = Recording::default();
    let scenario = scene(json!({"error_bars": true}));
    let ended = convergence_study::run(&scenario, 1, &stop, &mut recording);
    assert_eq!(ended, Ok(RunEnd::Stopped));
    assert!(recording.samples.is_empty(), "the answer was not begun");
}

#[test]
fn a_sink_that_refuses_progress_ends_everything() {
    struct Shut;
    impl Sink for Shut {
        type Error = &'static str;
        fn record(&mut self, _: Record) -> Result<(), Self::Error> {
            Ok(())
        }
        fn progress(&mut self, _: &Progress) -> Result<(), Self::Error> {
            Err("shut")
        }
    }
    let scenario = scene(json!({"error_bars": true}));
    let ended = convergence_study::run(&scenario, 1, &RunControl::default(), &mut Shut);
    assert_eq!(ended, Err(RunError::Sink("shut")));
}

#[test]
fn a_target_leaves_the_records_of_its_answer_alone() {
    let accuracy = json!({"target": 0.01, "quantity": "runout_m", "budget_point_steps": 3e5});
    let (outcome, recording) = completed(&scene(accuracy));
    let times: Vec<f64> = recording
        .samples
        .iter()
        .map(|sample| sample.time_s)
        .collect();
    assert_eq!(times.len(), 6, "{times:?}");
    assert!(times.is_sorted_by(|a, b| a < b), "{times:?}");
    let last = recording.samples[5].bodies[0].position_m;
    assert_eq!(last, outcome.bodies[0].final_position_m);
    let report = outcome.accuracy.unwrap();
    let answers = report.runs.iter().filter(|run| run.role == Role::Answer);
    assert_eq!(answers.count(), 1, "{report:?}");
    let verdict = report.target.unwrap();
    assert_eq!(verdict.met, verdict.reason.is_none(), "{verdict:?}");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_may_ask_for_error_bars() {
    let app = TestApp::start().await;
    let mut scene = tiny_scene();
    scene["accuracy"] = json!({"error_bars": true});
    let path = app.submit(&scene).await;
    let job = app.wait_for_success(&path).await;
    let body = &job["outcome"]["bodies"][0];
    assert_eq!(
        body["error_bars"]["displacement_m"]["value"],
        body["displacement_m"]
    );
    let runs = job["outcome"]["accuracy"]["runs"].as_array().unwrap();
    assert_eq!(runs.last().unwrap()["role"], "answer");
    assert_eq!(job["scenario"]["accuracy"]["error_bars"], true);
    app.stop().await;
}
