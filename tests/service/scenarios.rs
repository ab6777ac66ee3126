//! Checks that every scenario of the repository can be run.

use scree::runs::{Progress, RunControl, RunEnd, Sink, run};
use scree_solver::record::Record;
use scree_solver::scenario::Scenario;
use std::convert::Infallible;
use std::path::{Path, PathBuf};

/// Duration long enough for the flow to start, short enough for a test [s].
const LONGEST_RUN_S: f64 = 0.05;

/// Cells across the channel: the coarsest legal number that is still meaningful.
const CELLS_ACROSS: f64 = 4.0;

#[derive(Default)]
struct Collected {
    records: Vec<Record>,
    last: Progress,
}

impl Sink for Collected {
    type Error = Infallible;

    fn record(&mut self, record: Record) -> Result<(), Infallible> {
        self.records.push(record);
        Ok(())
    }

    fn progress(&mut self, progress: &Progress) -> Result<(), Infallible> {
        self.last = *progress;
        Ok(())
    }
}

fn shipped() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/scenarios");
    let entries = std::fs::read_dir(folder).unwrap();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

#[test]
fn every_shipped_scenario_runs_coarsely() {
    let files = shipped();
    assert!(!files.is_empty());
    for file in files {
        let text = std::fs::read_to_string(&file).unwrap();
        let mut scenario = Scenario::from_json(&text)
            .unwrap_or_else(|error| panic!("{}: {error:#?}", file.display()));
        scenario.duration_s = scenario.duration_s.min(LONGEST_RUN_S);
        scenario.numerics.cell_size_m = Some(scenario.channel.width_m / CELLS_ACROSS);
        let mut sink = Collected::default();
        let ended = run::run(&scenario, 1, &RunControl::default(), &mut sink).unwrap();
        let RunEnd::Completed(outcome) = ended else {
            panic!("{} was stopped", file.display())
        };
        assert_eq!(outcome.bodies.len(), scenario.bodies.len());
        assert_eq!(outcome.conservation.points_lost, 0, "{}", file.display());
        assert_eq!(sink.last.fraction, 1.0, "{}", file.display());
        let last = sink.records.iter().rev().find_map(|record| match record {
            Record::Sample(sample) => Some(sample.time_s),
            Record::Snapshot(_) => None,
        });
        assert_eq!(last, Some(scenario.duration_s), "{}", file.display());
    }
}
