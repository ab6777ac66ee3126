//! The sink of a run on the command line: keeps its records in memory, and saves its state.

use super::schedule::Schedule;
use crate::cli::console;
use crate::cli::files::FileError;
use crate::cli::meter::Meter;
use crate::cli::results_folder::SavedRun;
use scree::runs::{Progress, RunControl, Sink};
use scree_solver::record::{FlowMaps, FlowSnapshot, Record, Sample};

/// Records of a run, and its saved state.
#[derive(Debug)]
pub(super) struct Recording<'a> {
    records: Vec<Record>,
    /// Maps of the flow on a terrain, once the run is over.
    maps: Option<FlowMaps>,
    /// None for a run whose results go nowhere.
    saved: Option<(SavedRun, Schedule)>,
    stop: &'a RunControl,
    /// Share of the run that is done.
    pub(super) fraction: f64,
    pub(super) meter: Meter,
}

impl<'a> Recording<'a> {
    /// A recording that begins with the records of a saved run, if there are any.
    pub(super) fn new(
        records: Vec<Record>,
        saved: Option<SavedRun>,
        stop: &'a RunControl,
        meter: Meter,
    ) -> Self {
        Self {
            records,
            maps: None,
            saved: saved.map(|saved| (saved, Schedule::new())),
            stop,
            fraction: 0.0,
            meter,
        }
    }

    /// The records.
    pub(super) fn into_parts(self) -> Recorded {
        let mut recorded = Recorded {
            maps: self.maps,
            ..Recorded::default()
        };
        for record in self.records {
            match record {
                Record::Sample(sample) => recorded.samples.push(sample),
                Record::Snapshot(snapshot) => recorded.snapshots.push(snapshot),
            }
        }
        recorded
    }
}

impl Sink for Recording<'_> {
    type Error = FileError;

    fn record(&mut self, record: Record) -> Result<(), FileError> {
        self.records.push(record);
        Ok(())
    }

    fn flow_maps(&mut self, maps: &FlowMaps) -> Result<(), FileError> {
        self.maps = Some(maps.clone());
        Ok(())
    }

    fn progress(&mut self, progress: &Progress) -> Result<(), FileError> {
        self.fraction = progress.fraction;
        self.meter.show(progress);
        Ok(())
    }

    fn wants_state(&mut self) -> bool {
        let due = |(_, schedule): &mut (SavedRun, Schedule)| schedule.is_due();
        self.saved.as_mut().is_some_and(due)
    }

    fn state(&mut self, _: f64, state: &[u8]) -> Result<(), FileError> {
        let Some((saved, schedule)) = &mut self.saved else {
            return Ok(());
        };
        let result = saved.save(&self.records, state);
        schedule.saved();
        match result {
            // A disk that is full now may have space again when the run ends.
            Err(error) if !self.stop.is_raised() => {
                console::note(&format!(
                    "the run goes on, but its state is not saved: {error}"
                ));
                Ok(())
            }
            result => result,
        }
    }
}

/// Records of a run by kind.
#[derive(Debug, Default)]
pub(super) struct Recorded {
    pub(super) samples: Vec<Sample>,
    pub(super) snapshots: Vec<FlowSnapshot>,
    pub(super) maps: Option<FlowMaps>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::results_folder::{Formats, Interrupted, ResultsFolder, SavedState};
    use scree::results::fingerprint::Fingerprint;
    use scree::runs::convergence_study::Runs;
    use scree::runs::{RunEnd, Stop};
    use scree_solver::record::Outcome;
    use scree_solver::scenario::Scenario;

    /// Asks for a stop at the end of this many steps.
    struct Interrupter<'a> {
        recording: Recording<'a>,
        steps: usize,
    }

    impl Sink for Interrupter<'_> {
        type Error = FileError;

        fn record(&mut self, record: Record) -> Result<(), FileError> {
            self.recording.record(record)
        }

        fn progress(&mut self, progress: &Progress) -> Result<(), FileError> {
            self.recording.progress(progress)
        }

        fn wants_state(&mut self) -> bool {
            self.steps = self.steps.saturating_sub(1);
            if self.steps == 0 {
                self.recording.stop.ask(Stop::OnceSaved);
            }
            self.recording.wants_state()
        }

        fn state(&mut self, time_s: f64, state: &[u8]) -> Result<(), FileError> {
            self.recording.state(time_s, state)
        }
    }

    /// The outcome and the fingerprint of the records of a run that is cut off every so many
    /// steps, and the number of its parts.
    fn in_parts(text: &str, steps: usize) -> (Box<Outcome>, String, usize) {
        let scenario = Scenario::from_json(text).unwrap();
        let directory = tempfile::tempdir().unwrap();
        let folder = ResultsFolder::for_new_run(directory.path()).unwrap();
        drop(folder.save_run(text, &Formats::default()).unwrap());
        drop(folder);
        for part in 1.. {
            let (_lock, interrupted) = ResultsFolder::of_interrupted_run(directory.path()).unwrap();
            let Interrupted::Run { saved, state, .. } = interrupted else {
                panic!("a run was interrupted");
            };
            let (runs, records) = match state {
                Some(SavedState { state, records }) => {
                    (Runs::restored(&scenario, 1, &state).unwrap(), records)
                }
                None => (Runs::afresh(&scenario, 1).unwrap(), Vec::new()),
            };
            let stop = RunControl::default();
            let recording = Recording::new(records, Some(saved), &stop, Meter::Silent);
            let mut sink = Interrupter { recording, steps };
            if let RunEnd::Completed(outcome) = runs.go(&stop, &mut sink).unwrap() {
                let mut fingerprint = Fingerprint::default();
                let records = &sink.recording.records;
                records
                    .iter()
                    .for_each(|record| fingerprint.take_in(record));
                return (outcome, fingerprint.hex(), part);
            }
        }
        unreachable!("the run ends")
    }

    /// The outcome without the wall times.
    fn timeless(mut outcome: Outcome) -> Outcome {
        outcome.cost.wall_s = 0.0;
        outcome.cost.point_steps_per_s = 0.0;
        if let Some(report) = &mut outcome.accuracy {
            report.extra_wall_cost = None;
            report.runs.iter_mut().for_each(|run| run.wall_s = None);
        }
        outcome
    }

    #[test]
    fn runs_cut_off_again_and_again_have_the_same_bits() {
        let accuracies = [
            "{}",
            r#"{"error_bars": true}"#,
            r#"{"target": 0.5, "quantity": "displacement_m", "budget_point_steps": 4e5}"#,
        ];
        for accuracy in accuracies {
            let numerics = if accuracy.contains("target") {
                "{}"
            } else {
                r#"{"cell_size_m": 0.01}"#
            };
            let text = format!(
                r#"{{"channel": {{"inclination_deg": 40, "incline_length_m": 0.2,
                "runout_length_m": 0.3, "width_m": 0.06}}, "duration_s": 0.2,
                "flow": {{"volume_m3": 1e-4,
                          "release": {{"height_m": 0.03, "toe_distance_m": 0.0}}}},
                "bodies": [{{"shape": {{"cube": {{"side_m": 0.02}}}}, "sphero_radius_m": 0.001,
                            "position": {{"downstream_m": 0.015}}}}],
                "accuracy": {accuracy}, "numerics": {numerics}}}"#
            );
            let (whole, fingerprint, parts) = in_parts(&text, usize::MAX);
            assert_eq!(parts, 1);
            let (cut, again, parts) = in_parts(&text, 17);
            assert!(parts > 3, "{parts} parts, {accuracy}");
            assert_eq!(again, fingerprint, "{accuracy}");
            assert_eq!(timeless(*cut), timeless(*whole), "{accuracy}");
        }
    }

    /// A periodic state that can't be written ends no run; the one that a stop waits for does.
    #[test]
    fn a_state_that_cannot_be_written_matters_once_the_run_is_to_stop() {
        let directory = tempfile::tempdir().unwrap();
        let folder = ResultsFolder::for_new_run(directory.path()).unwrap();
        let saved = folder.save_run("{}", &Formats::default()).unwrap();
        folder.discard_partial().unwrap();
        let stop = RunControl::default();
        let mut recording = Recording::new(Vec::new(), Some(saved), &stop, Meter::Silent);
        recording.state(0.0, b"state").unwrap();
        stop.ask(Stop::OnceSaved);
        let error = recording.state(0.0, b"state").unwrap_err().to_string();
        let path = directory.path().display().to_string();
        assert!(
            error.contains("cannot write") && error.contains(&path),
            "{error}"
        );
    }
}
