//! Runs of a scenario, without the service.

use crate::app::tiny_scene;
use scree::results::TrajectoryColumns;
use scree::runs::{Progress, RunEnd, RunError, Sink, StopFlag, run};
use scree_solver::record::{Record, Sample};
use scree_solver::scenario::Scenario;

/// Keeps samples, up to a maximum number.
struct Samples {
    kept: Vec<Sample>,
    room: usize,
}

impl Sink for Samples {
    type Error = &'static str;

    fn record(&mut self, record: Record) -> Result<(), Self::Error> {
        let Record::Sample(sample) = record else {
            return Ok(());
        };
        if self.kept.len() == self.room {
            return Err("no room");
        }
        self.kept.push(sample);
        Ok(())
    }

    fn progress(&mut self, _progress: &Progress) -> Result<(), Self::Error> {
        Ok(())
    }
}

fn run(stop: &StopFlag, room: usize) -> (Result<RunEnd, RunError<&'static str>>, Vec<Sample>) {
    let scenario = Scenario::from_json(&tiny_scene().to_string()).unwrap();
    let mut sink = Samples {
        kept: Vec::new(),
        room,
    };
    let ended = run::run(&scenario, 1, stop, &mut sink);
    (ended, sink.kept)
}

#[test]
fn a_sink_that_refuses_ends_the_run() {
    let (ended, kept) = run(&StopFlag::default(), 3);
    assert_eq!(ended, Err(RunError::Sink("no room")));
    assert_eq!(kept.len(), 3);
    let (ended, _) = run(&StopFlag::default(), 0);
    assert_eq!(
        ended,
        Err(RunError::Sink("no room")),
        "the sample of time 0 counts too"
    );
}

#[test]
fn a_raised_flag_stops_the_run_and_keeps_what_there_is() {
    let stop = StopFlag::default();
    stop.raise();
    let (ended, kept) = run(&stop, usize::MAX);
    assert_eq!(ended, Ok(RunEnd::Stopped));
    let columns = TrajectoryColumns::of_body(&kept, 0);
    assert_eq!(columns.time_s[0], 0.0);
    assert!(columns.len() < 6, "stopped before the end");
}

#[test]
fn the_same_scenario_is_recorded_with_the_same_bits() {
    let (_, first) = run(&StopFlag::default(), usize::MAX);
    let (_, second) = run(&StopFlag::default(), usize::MAX);
    assert_eq!(first.len(), 6);
    assert_eq!(first, second);
}
