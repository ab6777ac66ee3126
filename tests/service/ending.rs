//! Runs that end before their duration, because nothing can move any more.

use scree::runs::{Progress, RunControl, RunEnd, Sink, run};
use scree_solver::record::{Outcome, Record};
use scree_solver::scenario::Scenario;
use serde_json::{Value, json};
use std::convert::Infallible;

/// Counts samples, and keeps the last progress.
#[derive(Default)]
struct Counted {
    samples: usize,
    snapshots: usize,
    last: Progress,
}

impl Sink for Counted {
    type Error = Infallible;

    fn record(&mut self, record: Record) -> Result<(), Infallible> {
        match record {
            Record::Sample(_) => self.samples += 1,
            Record::Snapshot(_) => self.snapshots += 1,
        }
        Ok(())
    }

    fn progress(&mut self, progress: &Progress) -> Result<(), Infallible> {
        self.last = *progress;
        Ok(())
    }
}

fn run(scene: &Value, ending: &str) -> (Outcome, Counted) {
    let mut scene = scene.clone();
    scene["numerics"]["ending"] = json!(ending);
    let scenario = Scenario::from_json(&scene.to_string()).unwrap();
    let mut sink = Counted::default();
    match run::run(&scenario, 1, &RunControl::default(), &mut sink) {
        Ok(RunEnd::Completed(outcome)) => (*outcome, sink),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_body_that_stands_alone_needs_no_more_than_a_tenth_of_a_second() {
    let scene = json!({
        "channel": {"inclination_deg": 0, "incline_length_m": 1, "runout_length_m": 1},
        "flow": null, "bodies": [{"shape": {"cube": {"side_m": 0.04}}}],
        "duration_s": 1, "numerics": {}
    });
    let (early, counted) = run(&scene, "auto");
    let ended = early.ended_early.expect("it ended");
    assert_eq!((ended.body_bound_m, ended.front_bound_m), (0.0, None));
    // Rest time of a cube of 4 cm, at the end of a millisecond.
    assert!(ended.time_s > 0.094 && ended.time_s < 0.098, "{ended:?}");
    // Time 0, every hundredth of a second, and the end; time 0, every sixtieth, and the end.
    assert_eq!((counted.samples, counted.snapshots), (11, 7));
    assert_eq!(counted.last.fraction, 1.0);
    let (full, counted) = run(&scene, "full");
    assert_eq!((full.ended_early, counted.samples), (None, 101));
    assert_eq!(
        full.bodies[0].displacement_m,
        early.bodies[0].displacement_m
    );
}

#[test]
fn an_early_end_changes_nothing_beyond_its_bounds() {
    let mut scene: Value =
        serde_json::from_str(include_str!("../../configs/scenarios/source_paper.json")).unwrap();
    scene["numerics"]["cell_size_m"] = json!(0.03);
    let ((early, _), (full, _)) = (run(&scene, "auto"), run(&scene, "full"));
    let ended = early.ended_early.expect("all of it comes to rest");
    let (ours, theirs) = (&early.bodies[0], &full.bodies[0]);
    assert_eq!(ours.onset_time_s, theirs.onset_time_s);
    assert_eq!(ours.peak_speed_m_s, theirs.peak_speed_m_s);
    assert_eq!(ours.stop_time_s, theirs.stop_time_s);
    let moved = (ours.displacement_m - theirs.displacement_m).abs();
    assert!(moved <= ended.body_bound_m + 1e-6, "{moved}");
    let fronts = early
        .flow
        .front_m
        .zip(full.flow.front_m)
        .map(|(a, b)| (a - b).abs());
    assert!(
        fronts <= ended.front_bound_m.map(|bound| bound + 1e-6),
        "{fronts:?}"
    );
}
