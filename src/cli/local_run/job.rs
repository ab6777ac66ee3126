//! The job of `scree run`: its scenario, its folder, and its start or saved state.

use crate::cli::arguments::RunOptions;
use crate::cli::failure::{Failure, not_set_up};
use crate::cli::results_folder::{
    Formats, Interrupted, Place, ResultsFolder, SavedRun, SavedState,
};
use crate::cli::{console, scenario_file, scenario_maps};
use scree::runs::convergence_study::Runs;
use scree_solver::record::Record;
use scree_solver::scenario::{NamedMap, Scenario};
use std::path::Path;

/// A scenario, and the folder for its results.
pub(super) struct Job {
    pub(super) scenario: Scenario,
    /// Its maps, by the paths of their files.
    pub(super) maps: Vec<NamedMap>,
    pub(super) folder: Option<ResultsFolder>,
    /// Formats of the trajectories in the folder.
    pub(super) formats: Formats,
    saved: Option<SavedRun>,
    state: Option<SavedState>,
}

/// Runs of a job, with the records that were made before and the saved run to be continued.
pub(super) struct Start {
    pub(super) runs: Runs,
    pub(super) records: Vec<Record>,
    pub(super) saved: Option<SavedRun>,
}

/// Answer to the command line.
pub(super) enum Asked {
    /// A run is to be computed.
    Compute(Box<Job>),
    /// The run was over before: its results are in the folder.
    Delivered(ResultsFolder, Place),
}

impl Asked {
    /// The job asked for.
    ///
    /// # Errors
    /// The scenario or the folder can't be used.
    pub(super) fn of(options: &RunOptions) -> Result<Self, Failure> {
        let formats = Formats::asked(&options.format);
        match (&options.resume, &options.scenario) {
            (Some(folder), _) => Self::resumed(folder, formats),
            (None, Some(file)) => {
                let formats = formats.unwrap_or_default();
                Job::new(file, options.out.as_deref(), formats).map(Self::compute)
            }
            (None, None) => Err(Failure::Input("no scenario is given".to_owned())),
        }
    }

    fn compute(job: Job) -> Self {
        Self::Compute(Box::new(job))
    }

    fn resumed(path: &Path, asked: Option<Formats>) -> Result<Self, Failure> {
        let (folder, interrupted) = ResultsFolder::of_interrupted_run(path)?;
        let (text, formats, saved, state) = match interrupted {
            Interrupted::Delivered(place) => return Ok(Self::Delivered(folder, place)),
            Interrupted::Run {
                scenario,
                formats,
                saved,
                state,
            } => (scenario, formats, saved, state),
        };
        if let Some(formats) = &asked {
            saved.choose(formats)?;
        }
        if state.is_none() {
            console::note("the run was interrupted before its first saved state: it begins anew");
        }
        Ok(Self::compute(Job {
            scenario: scenario_file::parse(&text, "the interrupted run's scenario")?,
            maps: scenario_maps::files_in(&text),
            folder: Some(folder),
            formats: asked.unwrap_or(formats),
            saved: Some(saved),
            state,
        }))
    }
}

impl Job {
    fn new(file: &Path, out: Option<&Path>, formats: Formats) -> Result<Self, Failure> {
        let text = scenario_file::read_text(file)?;
        let scenario = scenario_file::parse(&text, &scenario_file::name(file))?;
        let folder = out.map(ResultsFolder::for_new_run).transpose()?;
        let save = |folder: &ResultsFolder| -> Result<SavedRun, Failure> {
            folder.refuse_to_replace(file, &text, &scenario)?;
            Ok(folder.save_run(&text, &formats)?)
        };
        let saved = folder.as_ref().map(save).transpose()?;
        Ok(Self {
            scenario,
            maps: scenario_maps::files_in(&text),
            saved,
            folder,
            formats,
            state: None,
        })
    }

    /// The runs, from their start or from the saved state.
    ///
    /// # Errors
    /// The scenario can't be set up, or the state is not of this scenario and build.
    pub(super) fn start(&mut self, threads: usize) -> Result<Start, Failure> {
        let saved = self.saved.take();
        let (runs, records) = match (self.state.take(), &saved) {
            (Some(SavedState { state, records }), Some(saved)) => {
                let runs = Runs::restored(&self.scenario, threads, &state);
                let refused = |error| saved.not_resumable(&format!("{error}"));
                (runs.map_err(refused)?, records)
            }
            _ => {
                let runs = Runs::afresh(&self.scenario, threads);
                let runs = runs.map_err(|error| self.given_up(not_set_up(&error)))?;
                (runs, Vec::new())
            }
        };
        Ok(Start {
            runs,
            records,
            saved,
        })
    }
}
