//! Checks that every scenario of the repository can be run.

use scree::runs::{Progress, RunControl, RunEnd, Sink, run};
use scree::terrains::purpose;
use scree_solver::record::Record;
use scree_solver::scenario::{Maps, Scenario};
use serde_json::Value;
use std::convert::Infallible;
use std::path::{Path, PathBuf};
use std::sync::Arc;

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
    let files = entries.map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> = files.filter(|path| path.is_file()).collect();
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
        scenario.numerics.cell_size_m = Some(scenario.channel().unwrap().width_m / CELLS_ACROSS);
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

/// The scenario of a file, with the maps that it names by their paths.
fn on_terrain(file: &Path) -> Scenario {
    let text = std::fs::read_to_string(file).unwrap();
    let mut document: Value = serde_json::from_str(&text).unwrap();
    let mut maps = Maps::default();
    for map in Scenario::maps_named(&text).unwrap() {
        let path = file.parent().unwrap().join(&map.name);
        let bytes = std::fs::read(&path).unwrap();
        let raster = scree_rasters::read(&bytes, purpose(map.of).into()).unwrap();
        let hash = scree_rasters::hash(&bytes);
        maps.insert(&hash, Arc::new(raster));
        *document.pointer_mut(&map.pointer).unwrap() = hash.into();
    }
    Scenario::from_value_with(&document, &maps)
        .unwrap_or_else(|error| panic!("{}: {error:#?}", file.display()))
}

#[test]
fn every_shipped_scenario_on_a_terrain_runs_coarsely() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/scenarios/terrain");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let file = entry.unwrap().path();
        let mut scenario = on_terrain(&file);
        let cell_size_m = scenario.numerics.cell_size_m.unwrap();
        scenario.duration_s = scenario.duration_s.min(100.0 * cell_size_m.sqrt() * 0.1);
        scenario.numerics.cell_size_m = Some(2.0 * cell_size_m);
        let mut sink = Collected::default();
        let ended = run::run(&scenario, 1, &RunControl::default(), &mut sink).unwrap();
        let RunEnd::Completed(outcome) = ended else {
            panic!("{} was stopped", file.display())
        };
        assert_eq!(outcome.conservation.points_lost, 0, "{}", file.display());
        assert!(outcome.conservation.momentum_residual < 1e-5);
        count += 1;
    }
    assert!(count >= 4);
}
