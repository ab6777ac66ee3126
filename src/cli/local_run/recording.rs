//! The sink of a run on the command line: keeps its records in memory, and saves its state.

use super::schedule::Schedule;
use crate::cli::console;
use crate::cli::files::FileError;
use crate::cli::meter::Meter;
use crate::cli::results_folder::SavedRun;
use scree::results::{TrajectoryColumns, trajectory_json};
use scree::runs::{Progress, Sink, StopFlag};
use scree_solver::record::{FlowSnapshot, Record, Sample};

/// Records of a run, and its saved state.
#[derive(Debug)]
pub(super) struct Recording<'a> {
    records: Vec<Record>,
    /// None for a run whose results go nowhere.
    saved: Option<(SavedRun, Schedule)>,
    stop: &'a StopFlag,
    /// Share of the run that is done.
    pub(super) fraction: f64,
    pub(super) meter: Meter,
}

impl<'a> Recording<'a> {
    /// A recording that begins with the records of a saved run, if there are any.
    pub(super) fn new(
        records: Vec<Record>,
        saved: Option<SavedRun>,
        stop: &'a StopFlag,
        meter: Meter,
    ) -> Self {
        Self {
            records,
            saved: saved.map(|saved| (saved, Schedule::new())),
            stop,
            fraction: 0.0,
            meter,
        }
    }

    /// The records.
    pub(super) fn into_parts(self) -> Recorded {
        let mut recorded = Recorded::default();
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
}

impl Recorded {
    /// Trajectory document of a body.
    pub(super) fn trajectory(&self, body: usize) -> String {
        let columns = TrajectoryColumns::of_body(&self.samples, body);
        trajectory_json(None, body, &columns)
    }
}
