//! The folder of a run's results. Everything is written into a folder of its own in it, and moved
//! to its place once it is whole; until then, an earlier run's results stay as they are.

mod delivery;
mod formats;
mod frame;
mod lock;
mod saved;
pub(super) mod terrain;

use super::failure::Failure;
use super::files::{self, FileError};
use super::scenario_maps;
pub(super) use delivery::{Delivery, Place};
pub(super) use formats::{Formats, file_name};
pub(super) use saved::{Interrupted, SavedRun, SavedState};
use scree_solver::record::Outcome;
use scree_solver::scenario::Scenario;
use serde_json::Value;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// Name of the folder for all that is not whole yet.
const PARTIAL: &str = ".scree-partial";

/// Name of the file of the outcome.
pub(super) const OUTCOME: &str = "outcome.json";

/// Name of the file of the scenario.
pub(super) const SCENARIO: &str = "scenario.json";

/// Name of the file of the plan.
pub(super) const PLAN: &str = "plan.json";

/// Names of the files of the pictures.
pub(super) const PICTURES: [&str; 2] = ["motion.svg", "aerial.svg"];

/// A folder for results that no other run uses meanwhile.
#[derive(Debug)]
pub(super) struct ResultsFolder {
    path: PathBuf,
    partial: PathBuf,
    /// Held until the folder is dropped, or the process ends, however it does.
    _lock: File,
}

impl ResultsFolder {
    /// Opens a folder for a new run; it is created if it does not exist. Done before any
    /// computation, so that a bad name costs no time.
    ///
    /// # Errors
    /// The folder can't be used, another run uses it, or it holds an interrupted run.
    pub(super) fn for_new_run(path: &Path) -> Result<Self, Failure> {
        make_folder(path)?;
        let folder = Self::locked(path)?;
        folder.complete_delivery()?;
        if folder.has_saved_state() {
            let partial = folder.partial.display();
            return Err(Failure::Input(format!(
                "{path} holds an interrupted run: `scree run --resume {path}` continues it; \
                 to begin anew, remove {partial}",
                path = path.display()
            )));
        }
        folder.refuse_foreign_files()?;
        Ok(folder)
    }

    /// Refuses a folder with files that have names of results but are those of no run: they are
    /// somebody's own.
    fn refuse_foreign_files(&self) -> Result<(), Failure> {
        let mut foreign = [SCENARIO, PLAN]
            .into_iter()
            .map(|name| self.path.join(name));
        match foreign.find(|path| path.exists()) {
            Some(path) if !self.has_results() => Err(would_be_replaced(&path)),
            _ => Ok(()),
        }
    }

    /// Refuses to replace the file of the scenario itself by the scenario with its defaults.
    ///
    /// # Errors
    /// The file is in this folder, and its text is another.
    pub(super) fn refuse_to_replace(
        &self,
        file: &Path,
        text: &str,
        scenario: &Scenario,
    ) -> Result<(), Failure> {
        let real = |path: &Path| path.canonicalize().ok();
        let is_result =
            real(file).is_some_and(|file| real(&self.path.join(SCENARIO)) == Some(file));
        if !is_result {
            return Ok(());
        }
        let maps = scenario_maps::files_in(text);
        let result = delivery::scenario_text(scenario, &maps)?;
        // A text with maps is not as it was in the file.
        let document = |text: &str| serde_json::from_str::<Value>(text).ok();
        if text == result || !maps.is_empty() && document(text) == document(&result) {
            return Ok(());
        }
        Err(would_be_replaced(file))
    }

    /// Opens the folder of an interrupted run.
    ///
    /// # Errors
    /// The folder can't be used, another run uses it, or it holds no interrupted run.
    pub(super) fn of_interrupted_run(path: &Path) -> Result<(Self, Interrupted), Failure> {
        let partial = path.join(PARTIAL);
        if !partial.is_dir() {
            let partial = partial.display();
            return Err(Failure::Input(format!(
                "{} holds no interrupted run: there is no {partial}",
                path.display()
            )));
        }
        let folder = Self::locked(path)?;
        let interrupted = match folder.complete_delivery()? {
            Some(place) => Interrupted::Delivered(place),
            None => SavedRun::read(&folder.partial)?,
        };
        Ok((folder, interrupted))
    }

    fn locked(path: &Path) -> Result<Self, Failure> {
        Ok(Self {
            path: path.to_path_buf(),
            partial: path.join(PARTIAL),
            _lock: lock::take(path)?,
        })
    }

    /// Begins to save the run of the scenario with this text, whose trajectories are to be
    /// written in these formats.
    ///
    /// # Errors
    /// A file can't be written.
    pub(super) fn save_run(
        &self,
        scenario: &str,
        formats: &Formats,
    ) -> Result<SavedRun, FileError> {
        self.discard_partial()?;
        SavedRun::begin(&self.partial, scenario, formats)
    }

    /// Begins to write results.
    ///
    /// # Errors
    /// A folder can't be made.
    pub(super) fn deliver(&self, place: Place) -> Result<Delivery<'_>, FileError> {
        Delivery::begin(self, place)
    }

    /// The outcome in the folder.
    ///
    /// # Errors
    /// There is none, or it can't be read.
    pub(super) fn outcome(&self) -> Result<Outcome, Failure> {
        let path = self.path.join(OUTCOME);
        let text = fs::read(&path).map_err(files::failed("read", &path))?;
        serde_json::from_slice(&text)
            .map_err(|error| Failure::other(&format!("cannot read {}", path.display()), error))
    }

    /// True if the folder holds whole results.
    pub(super) fn has_results(&self) -> bool {
        self.path.join(OUTCOME).exists()
    }

    /// True if the folder holds the saved state of a run.
    pub(super) fn has_saved_state(&self) -> bool {
        SavedRun::has_state(&self.partial)
    }

    /// Path of the folder.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Folder for this place.
    pub(super) fn of(&self, place: Place) -> PathBuf {
        match place {
            Place::Whole => self.path.clone(),
            Place::Failed => self.path.join("failed"),
        }
    }

    /// Removes all that is not whole.
    ///
    /// # Errors
    /// The system's.
    pub(super) fn discard_partial(&self) -> Result<(), FileError> {
        let scenario = SavedRun::scenario_file(&self.partial);
        // First, so that what is left after a crash is no interrupted run.
        files::unless_missing(fs::remove_file(&scenario))
            .map_err(files::failed("remove", &scenario))?;
        let partial = &self.partial;
        files::unless_missing(fs::remove_dir_all(partial)).map_err(files::failed("remove", partial))
    }
}

/// Makes a folder for results, unless it is there.
fn make_folder(path: &Path) -> Result<(), Failure> {
    let Err(error) = fs::create_dir_all(path) else {
        return Ok(());
    };
    // A name that is taken, but by no folder.
    match (fs::read_link(path), path.symlink_metadata()) {
        (Ok(target), _) => Err(Failure::Input(format!(
            "{} is a link to {}, which is no folder",
            path.display(),
            target.display()
        ))),
        (Err(_), Ok(_)) => Err(Failure::Input(format!(
            "{} is a file: results go into a folder",
            path.display()
        ))),
        (Err(_), Err(_)) => Err(Failure::path("make", path, &error)),
    }
}

/// Failure of a run whose results would replace a file that is not of a run.
fn would_be_replaced(path: &Path) -> Failure {
    Failure::Input(format!(
        "{} would be replaced by the results' file of this name: move it, or choose another folder",
        path.display()
    ))
}

/// Names of the results in a folder.
fn results_in(folder: &Path) -> io::Result<Vec<String>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder)? {
        let name = entry?.file_name();
        let Some(name) = name.to_str() else { continue };
        let documents = [OUTCOME, SCENARIO, PLAN];
        let is_other = documents.contains(&name) || PICTURES.contains(&name);
        if formats::is_trajectory(name) || terrain::is_of_terrain(name) || is_other {
            names.push(name.to_owned());
        }
    }
    Ok(names)
}
