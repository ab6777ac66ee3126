//! Runs of a scenario, without the service.

use crate::app::tiny_scene;
use scree::results::TrajectoryColumns;
use scree::runs::{Progress, RunControl, RunEnd, RunError, Sink, run};
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

fn run(stop: &RunControl, room: usize) -> (Result<RunEnd, RunError<&'static str>>, Vec<Sample>) {
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
    let (ended, kept) = run(&RunControl::default(), 3);
    assert_eq!(ended, Err(RunError::Sink("no room")));
    assert_eq!(kept.len(), 3);
    let (ended, _) = run(&RunControl::default(), 0);
    assert_eq!(
        ended,
        Err(RunError::Sink("no room")),
        "the sample of time 0 counts too"
    );
}

#[test]
fn a_raised_flag_stops_the_run_and_keeps_what_there_is() {
    let stop = RunControl::default();
    stop.raise();
    let (ended, kept) = run(&stop, usize::MAX);
    assert_eq!(ended, Ok(RunEnd::Stopped));
    let columns = TrajectoryColumns::of_body(&kept, 0);
    assert_eq!(columns.time_s[0], 0.0);
    assert!(columns.len() < 6, "stopped before the end");
}

/// Asks its run for another number of threads with every sample.
struct OtherThreads<'a> {
    control: &'a RunControl,
    kept: Vec<Sample>,
}

impl Sink for OtherThreads<'_> {
    type Error = &'static str;

    fn record(&mut self, record: Record) -> Result<(), Self::Error> {
        if let Record::Sample(sample) = record {
            self.control.ask_for_threads(1 + self.kept.len() % 3);
            self.kept.push(sample);
        }
        Ok(())
    }

    fn progress(&mut self, _progress: &Progress) -> Result<(), Self::Error> {
        Ok(())
    }
}

#[test]
fn other_threads_on_the_way_change_no_bit() {
    let control = RunControl::default();
    let mut sink = OtherThreads {
        control: &control,
        kept: Vec::new(),
    };
    let scenario = Scenario::from_json(&tiny_scene().to_string()).unwrap();
    let ended = run::run(&scenario, 1, &control, &mut sink);
    let (alone, kept) = run(&RunControl::default(), usize::MAX);
    // Only the wall time differs.
    assert!(matches!(
        (ended, alone),
        (Ok(RunEnd::Completed(_)), Ok(RunEnd::Completed(_)))
    ));
    assert_eq!(sink.kept, kept);
}

#[test]
fn the_same_scenario_is_recorded_with_the_same_bits() {
    let (_, first) = run(&RunControl::default(), usize::MAX);
    let (_, second) = run(&RunControl::default(), usize::MAX);
    assert_eq!(first.len(), 6);
    assert_eq!(first, second);
}
