//! The output directory of a run.

use super::failure::Failure;
use scree::pictures;
use scree_solver::record::{FlowSnapshot, Outcome, Sample};
use scree_solver::scenario::Scenario;
use std::path::{Path, PathBuf};

/// A directory for results, and the list of files written there.
#[derive(Debug)]
pub(super) struct OutputDirectory {
    path: PathBuf,
    written: Vec<String>,
}

impl OutputDirectory {
    /// Creates the directory before any computation, so that a bad name costs no
    /// time, and removes an earlier run's results: a run that fails must
    /// not leave them beside its own.
    ///
    /// # Errors
    /// The directory can't be created or cleared.
    pub(super) fn create(path: &Path) -> Result<Self, Failure> {
        std::fs::create_dir_all(path).map_err(|error| Failure::path("make", path, &error))?;
        clear(path).map_err(|error| Failure::path("clear", path, &error))?;
        Ok(Self {
            path: path.to_path_buf(),
            written: Vec::new(),
        })
    }

    /// Writes the outcome.
    ///
    /// # Errors
    /// The file can't be written.
    pub(super) fn outcome(&mut self, outcome: &Outcome) -> Result<(), Failure> {
        let text = serde_json::to_string_pretty(outcome)? + "\n";
        self.write("outcome.json", text.as_bytes())
    }

    /// Writes the trajectory document of a body.
    ///
    /// # Errors
    /// The file can't be written.
    pub(super) fn trajectory(&mut self, body: usize, document: &[u8]) -> Result<(), Failure> {
        self.write(&format!("trajectory-{body}.json"), document)
    }

    /// Draws and writes the pictures.
    ///
    /// # Errors
    /// A picture can't be drawn or written.
    pub(super) fn pictures(
        &mut self,
        scenario: &Scenario,
        samples: &[Sample],
        snapshots: &[FlowSnapshot],
        outcome: &Outcome,
    ) -> Result<(), Failure> {
        let motion = pictures::motion(scenario, samples, outcome)?;
        self.write("motion.svg", motion.as_bytes())?;
        let aerial = pictures::aerial_view(scenario, samples, snapshots)?;
        self.write("aerial.svg", aerial.as_bytes())
    }

    /// Paths of the files, for people.
    pub(super) fn summary(&self) -> String {
        let names = self.written.join(", ");
        format!("written to {}: {names}", self.path.display())
    }

    fn write(&mut self, name: &str, contents: &[u8]) -> Result<(), Failure> {
        let path = self.path.join(name);
        std::fs::write(&path, contents)
            .map_err(|error| Failure::other(&format!("cannot write {}", path.display()), error))?;
        self.written.push(name.to_owned());
        Ok(())
    }
}

/// Removes only the files that a run writes.
fn clear(directory: &Path) -> std::io::Result<()> {
    for entry in std::fs::read_dir(directory)? {
        let entry = entry?;
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let is_trajectory = name
            .strip_prefix("trajectory-")
            .and_then(|rest| rest.strip_suffix(".json"))
            .is_some_and(|body| body.parse::<usize>().is_ok());
        if is_trajectory || ["outcome.json", "motion.svg", "aerial.svg"].contains(&&*name) {
            std::fs::remove_file(entry.path())?;
        }
    }
    Ok(())
}
