//! Delivery of results: written into a folder of their own, then listed, then moved. From the list
//! on, the delivery is completed by whoever opens the folder next, should this process end.

use super::{Formats, OUTCOME, PICTURES, PLAN, ResultsFolder, SCENARIO, results_in};
use crate::cli::failure::Failure;
use crate::cli::files::{self, FileError};
use crate::cli::scenario_maps;
use scree::pictures::{self, MapsSeen};
use scree_solver::record::{FlowMaps, FlowSnapshot, Outcome, Sample};
use scree_solver::scenario::{NamedMap, Scenario};
use serde::{Deserialize, Serialize};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Place of results.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(in crate::cli) enum Place {
    /// The folder itself: results of a completed run.
    Whole,
    /// A folder in it: results of a run up to its numerical failure.
    Failed,
}

/// Results that are whole; the file exists once they are.
#[derive(Debug, Serialize, Deserialize)]
struct List {
    place: Place,
    files: Vec<String>,
}

/// Results while they are written.
#[derive(Debug)]
pub(in crate::cli) struct Delivery<'a> {
    folder: &'a ResultsFolder,
    list: List,
}

impl<'a> Delivery<'a> {
    pub(super) fn begin(folder: &'a ResultsFolder, place: Place) -> Result<Self, FileError> {
        let new = folder.new_files();
        files::unless_missing(fs::remove_dir_all(&new)).map_err(files::failed("clear", &new))?;
        fs::create_dir_all(&new).map_err(files::failed("make", &new))?;
        let files = Vec::new();
        Ok(Self {
            folder,
            list: List { place, files },
        })
    }

    /// Writes the outcome, and the plan in it.
    ///
    /// # Errors
    /// A file can't be written.
    pub(in crate::cli) fn outcome(&mut self, outcome: &Outcome) -> Result<(), Failure> {
        if let Some(plan) = &outcome.plan {
            self.write(PLAN, pretty(plan)?.as_bytes())?;
        }
        self.write(OUTCOME, pretty(outcome)?.as_bytes())
    }

    /// Writes the scenario with its defaults; it names these maps by their paths.
    ///
    /// # Errors
    /// The file can't be written.
    pub(in crate::cli) fn scenario(
        &mut self,
        scenario: &Scenario,
        maps: &[NamedMap],
    ) -> Result<(), Failure> {
        self.write(SCENARIO, scenario_text(scenario, maps)?.as_bytes())
    }

    /// Writes the trajectory of a body in these formats.
    ///
    /// # Errors
    /// A file can't be written.
    pub(in crate::cli) fn trajectory(
        &mut self,
        body: usize,
        samples: &[Sample],
        formats: &Formats,
    ) -> Result<(), Failure> {
        let mut files = formats.files_of(samples, body);
        files.try_for_each(|(name, contents)| self.write(&name, &contents))
    }

    /// Draws and writes the pictures.
    ///
    /// # Errors
    /// A picture can't be drawn or written.
    pub(in crate::cli) fn pictures(
        &mut self,
        scenario: &Scenario,
        (samples, snapshots, maps): (&[Sample], &[FlowSnapshot], Option<&FlowMaps>),
        outcome: &Outcome,
    ) -> Result<(), Failure> {
        let [motion, aerial] = PICTURES;
        let drawn = pictures::motion(scenario, samples, outcome)?;
        self.write(motion, drawn.as_bytes())?;
        let drawn = match scenario.terrain() {
            None => pictures::aerial_view(scenario, samples, snapshots)?,
            Some(_) => {
                let maps = maps.map(MapsSeen::of);
                pictures::terrain_view(scenario, samples, maps.as_ref())?
            }
        };
        self.write(aerial, drawn.as_bytes())
    }

    /// Writes a file with the name of a result.
    ///
    /// # Errors
    /// The file can't be written.
    pub(in crate::cli) fn write(&mut self, name: &str, contents: &[u8]) -> Result<(), Failure> {
        files::write(&self.folder.new_files().join(name), contents)?;
        self.list.files.push(name.to_owned());
        Ok(())
    }

    /// Moves the files to their place, in which they replace an earlier run's, and removes all
    /// that is not whole. Returns the paths of the files, for people.
    ///
    /// # Errors
    /// The system's.
    pub(in crate::cli) fn finish(self) -> Result<String, Failure> {
        let Self { folder, list } = self;
        files::sync_folder(&folder.new_files())?;
        files::replace(&folder.list_file(), &serde_json::to_vec(&list)?)?;
        folder.carry_out(&list)?;
        let names = list.files.join(", ");
        Ok(format!("{}: {names}", folder.of(list.place).display()))
    }
}

impl ResultsFolder {
    fn new_files(&self) -> PathBuf {
        self.partial.join("new")
    }

    fn list_file(&self) -> PathBuf {
        self.partial.join("new.json")
    }

    /// Completes the delivery that another process began to move, and returns its place; none if
    /// there is no such delivery.
    ///
    /// # Errors
    /// The system's, or the list can't be read.
    pub(super) fn complete_delivery(&self) -> Result<Option<Place>, Failure> {
        let path = self.list_file();
        let text = match fs::read(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            text => text.map_err(files::failed("read", &path))?,
        };
        let list: List = serde_json::from_slice(&text)
            .map_err(|error| Failure::other(&format!("cannot read {}", path.display()), error))?;
        self.carry_out(&list)?;
        Ok(Some(list.place))
    }

    /// May be repeated after any interruption.
    fn carry_out(&self, list: &List) -> Result<(), FileError> {
        let place = self.of(list.place);
        fs::create_dir_all(&place).map_err(files::failed("make", &place))?;
        // An outcome is there only together with all files of its run.
        if self.new_files().join(OUTCOME).exists() {
            remove(&place.join(OUTCOME))?;
        }
        let (last, first): (Vec<_>, Vec<_>) = list.files.iter().partition(|name| *name == OUTCOME);
        for name in first.iter().chain(&last) {
            let (from, to) = (self.new_files().join(name), place.join(name));
            // One that is not there has been moved already.
            files::unless_missing(fs::rename(&from, &to)).map_err(files::failed("write", &to))?;
        }
        remove_results(&place, &list.files)?;
        if list.place == Place::Whole {
            let failed = self.of(Place::Failed);
            if failed.is_dir() {
                remove_results(&failed, &[])?;
                // It stays if the user has files in it.
                let _ = fs::remove_dir(&failed);
            }
        }
        files::sync_folder(&place)?;
        files::sync_folder(&self.path)?;
        self.discard_partial()
    }
}

/// Text of the file of a scenario.
pub(super) fn scenario_text(scenario: &Scenario, maps: &[NamedMap]) -> Result<String, Failure> {
    Ok(scenario_maps::with_paths(pretty(scenario)?, maps))
}

fn pretty(document: &impl Serialize) -> Result<String, Failure> {
    Ok(serde_json::to_string_pretty(document)? + "\n")
}

/// Removes the results in a folder but those to keep.
fn remove_results(folder: &Path, keep: &[String]) -> Result<(), FileError> {
    let names = results_in(folder).map_err(files::failed("read", folder))?;
    let mut stale = names.iter().filter(|name| !keep.contains(name));
    stale.try_for_each(|name| remove(&folder.join(name)))
}

fn remove(path: &Path) -> Result<(), FileError> {
    files::unless_missing(fs::remove_file(path)).map_err(files::failed("remove", path))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn write_all(delivery: &mut Delivery, names: &[&str], text: &str) {
        for name in names {
            delivery.write(name, text.as_bytes()).unwrap();
        }
    }

    fn text(folder: &Path, name: &str) -> Option<String> {
        fs::read_to_string(folder.join(name)).ok()
    }

    /// The moves cut off after each of their number: the next to open the folder completes them.
    #[test]
    fn a_delivery_that_was_cut_off_is_completed() {
        let names = [OUTCOME, "motion.svg", "trajectory-0.json"];
        for moved in 0..=names.len() {
            let directory = tempfile::tempdir().unwrap();
            let path = directory.path();
            for old in [OUTCOME, "motion.svg", "trajectory-1.json", "notes.json"] {
                fs::write(path.join(old), "old").unwrap();
            }
            let folder = ResultsFolder::for_new_run(path).unwrap();
            let mut delivery = folder.deliver(Place::Whole).unwrap();
            write_all(&mut delivery, &names, "new");
            let list = serde_json::to_vec(&delivery.list).unwrap();
            fs::write(folder.list_file(), list).unwrap();
            for name in names.iter().rev().take(moved) {
                fs::rename(folder.new_files().join(name), path.join(name)).unwrap();
            }
            drop(folder);
            drop(ResultsFolder::for_new_run(path).unwrap());
            for name in names {
                assert_eq!(text(path, name).as_deref(), Some("new"), "{name}, {moved}");
            }
            assert_eq!(text(path, "trajectory-1.json"), None);
            assert_eq!(text(path, "notes.json").as_deref(), Some("old"));
            assert!(!path.join(super::super::PARTIAL).exists());
        }
    }

    #[test]
    fn without_the_list_nothing_is_delivered() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path();
        fs::write(path.join(OUTCOME), "old").unwrap();
        let folder = ResultsFolder::for_new_run(path).unwrap();
        let mut delivery = folder.deliver(Place::Whole).unwrap();
        write_all(&mut delivery, &[OUTCOME], "new");
        drop(folder);
        let folder = ResultsFolder::for_new_run(path).unwrap();
        assert_eq!(text(path, OUTCOME).as_deref(), Some("old"));
        // The next delivery has none of its files.
        let delivery = folder.deliver(Place::Whole).unwrap();
        assert_eq!(fs::read_dir(folder.new_files()).unwrap().count(), 0);
        delivery.finish().unwrap();
        assert_eq!(text(path, OUTCOME), None);
    }
}
