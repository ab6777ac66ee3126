//! A run's saved state on disk, from which `scree run --resume` continues: the scenario, the
//! records so far in frames that are only ever appended, and the state with the number of bytes of
//! records that belong to it.

use super::delivery::Place;
use super::{Formats, frame};
use crate::cli::failure::Failure;
use crate::cli::files::{self, FileError, failed};
use scree::results::fingerprint::Fingerprint;
use scree::runs::COMMIT;
use scree_solver::VERSION;
use scree_solver::record::Record;
use serde::{Deserialize, Serialize};
use std::fs::{self, File};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// First line of the file of the state, in JSON, so that any build can tell whose it is.
#[derive(Debug, Serialize, Deserialize)]
struct Head {
    version: String,
    commit: String,
    /// Hash of the scenario's text.
    scenario: String,
    /// Bytes of the records' file that were there with this state.
    records_bytes: u64,
    /// Fingerprint of these records.
    fingerprint: String,
}

/// Result of reading an interrupted run.
#[derive(Debug)]
pub(in crate::cli) enum Interrupted {
    /// The run was over; its results are in their place now.
    Delivered(Place),
    /// The run was cut off.
    Run {
        /// Text of its scenario.
        scenario: String,
        /// Formats of its trajectories.
        formats: Formats,
        /// The saved run, to be continued.
        saved: SavedRun,
        /// Its last state and the records until then; none if it was cut off before the first.
        state: Option<SavedState>,
    },
}

/// A state, and all records until then.
#[derive(Debug)]
pub(in crate::cli) struct SavedState {
    pub(in crate::cli) state: Vec<u8>,
    pub(in crate::cli) records: Vec<Record>,
}

/// A run's state on disk.
#[derive(Debug)]
pub(in crate::cli) struct SavedRun {
    folder: PathBuf,
    scenario: String,
    records: usize,
    records_bytes: u64,
    fingerprint: Fingerprint,
}

impl SavedRun {
    /// File of the scenario in this folder: there is an interrupted run if it exists.
    pub(super) fn scenario_file(folder: &Path) -> PathBuf {
        folder.join("scenario.json")
    }

    fn formats_file(folder: &Path) -> PathBuf {
        folder.join("formats")
    }

    fn records_file(folder: &Path) -> PathBuf {
        folder.join("records")
    }

    fn state_file(folder: &Path) -> PathBuf {
        folder.join("state")
    }

    /// True if there is a run that has got so far as to save its state.
    pub(super) fn has_state(folder: &Path) -> bool {
        Self::scenario_file(folder).exists() && Self::state_file(folder).exists()
    }

    /// Begins with the scenario, and the formats to be written at the end.
    pub(super) fn begin(
        folder: &Path,
        scenario: &str,
        formats: &Formats,
    ) -> Result<Self, FileError> {
        fs::create_dir_all(folder).map_err(failed("make", folder))?;
        // Before the scenario, whose file makes an interrupted run of the folder.
        files::replace(&Self::formats_file(folder), formats.words().as_bytes())?;
        files::replace(&Self::scenario_file(folder), scenario.as_bytes())?;
        Ok(Self::without_records(folder, scenario))
    }

    fn without_records(folder: &Path, scenario: &str) -> Self {
        Self {
            folder: folder.to_path_buf(),
            scenario: blake3::hash(scenario.as_bytes()).to_hex().to_string(),
            records: 0,
            records_bytes: 0,
            fingerprint: Fingerprint::default(),
        }
    }

    /// Saves the state after `records`, all of the run so far. If it fails, the state before
    /// stays valid.
    ///
    /// # Errors
    /// A file can't be written.
    pub(in crate::cli) fn save(
        &mut self,
        records: &[Record],
        state: &[u8],
    ) -> Result<(), FileError> {
        let new = &records[self.records..];
        let records_bytes = self.append(new)?;
        let mut fingerprint = self.fingerprint;
        new.iter().for_each(|record| fingerprint.take_in(record));
        let head = Head {
            version: VERSION.to_owned(),
            commit: COMMIT.to_owned(),
            scenario: self.scenario.clone(),
            records_bytes,
            fingerprint: fingerprint.hex(),
        };
        let path = Self::state_file(&self.folder);
        let mut bytes = serde_json::to_vec(&head).expect("plain data always serialises");
        bytes.push(b'\n');
        bytes.extend(frame_at(&path, state)?);
        files::replace(&path, &bytes)?;
        self.records = records.len();
        self.records_bytes = records_bytes;
        self.fingerprint = fingerprint;
        Ok(())
    }

    /// Appends a frame of records, and returns the length of the file.
    fn append(&self, new: &[Record]) -> Result<u64, FileError> {
        if new.is_empty() {
            return Ok(self.records_bytes);
        }
        let path = Self::records_file(&self.folder);
        let raw = postcard::to_allocvec(new).expect("plain data always serialises");
        let frame = frame_at(&path, &raw)?;
        let written = File::options()
            .create(true)
            .write(true)
            .truncate(false)
            .open(&path)
            .and_then(|mut file| {
                // What an attempt after the last state has left is overwritten.
                file.set_len(self.records_bytes)?;
                file.seek(SeekFrom::End(0))?;
                file.write_all(&frame)?;
                file.sync_all()
            });
        written.map_err(failed("write", &path))?;
        Ok(self.records_bytes + frame.len() as u64)
    }

    /// Reads the run in this folder.
    ///
    /// # Errors
    /// There is none, its files are damaged, or they are of another build.
    pub(super) fn read(folder: &Path) -> Result<Interrupted, Failure> {
        let path = Self::scenario_file(folder);
        let scenario =
            fs::read_to_string(&path).map_err(|error| Failure::path("read", &path, &error))?;
        let mut saved = Self::without_records(folder, &scenario);
        let state = saved.read_state(&scenario)?;
        Ok(Interrupted::Run {
            formats: Self::read_formats(folder)?,
            scenario,
            saved,
            state,
        })
    }

    /// The formats; those without a word of the user's if another build has begun the run.
    fn read_formats(folder: &Path) -> Result<Formats, Failure> {
        let path = Self::formats_file(folder);
        match fs::read_to_string(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Formats::default()),
            words => {
                let words = words.map_err(|error| Failure::path("read", &path, &error))?;
                Ok(Formats::from_words(&words).unwrap_or_default())
            }
        }
    }

    /// Has the trajectories written in other formats.
    ///
    /// # Errors
    /// The file can't be written.
    pub(in crate::cli) fn choose(&self, formats: &Formats) -> Result<(), FileError> {
        let path = Self::formats_file(&self.folder);
        files::replace(&path, formats.words().as_bytes())
    }

    fn read_state(&mut self, scenario: &str) -> Result<Option<SavedState>, Failure> {
        let path = Self::state_file(&self.folder);
        let bytes = match fs::read(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            bytes => bytes.map_err(|error| Failure::path("read", &path, &error))?,
        };
        let parted = bytes.iter().position(|byte| *byte == b'\n');
        let (head, rest) = bytes.split_at(parted.map_or(bytes.len(), |end| end + 1));
        let head: Head = serde_json::from_slice(head).map_err(|_| self.damaged(&path))?;
        self.check_build(&head, &path)?;
        if head.scenario != blake3::hash(scenario.as_bytes()).to_hex().to_string() {
            let scenario = Self::scenario_file(&self.folder);
            return Err(self.not_resumable(&format!(
                "{} is not the scenario of the run that {} was saved by",
                scenario.display(),
                path.display()
            )));
        }
        let (state, _) = frame::opened(rest).ok_or_else(|| self.damaged(&path))?;
        let records = self.read_records(&head)?;
        Ok(Some(SavedState { state, records }))
    }

    fn check_build(&self, head: &Head, path: &Path) -> Result<(), Failure> {
        if (head.version.as_str(), head.commit.as_str()) == (VERSION, COMMIT) {
            return Ok(());
        }
        Err(self.not_resumable(&format!(
            "{} was saved by solver {} of commit {}, and this is solver {VERSION} of commit \
             {COMMIT}, which may round otherwise",
            path.display(),
            head.version,
            head.commit
        )))
    }

    fn read_records(&mut self, head: &Head) -> Result<Vec<Record>, Failure> {
        let path = Self::records_file(&self.folder);
        let bytes = match fs::read(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
            bytes => bytes.map_err(|error| Failure::path("read", &path, &error))?,
        };
        let length = usize::try_from(head.records_bytes).unwrap_or(usize::MAX);
        let records = bytes.get(..length).and_then(unframed);
        let records = records.ok_or_else(|| self.damaged(&path))?;
        let mut fingerprint = Fingerprint::default();
        records
            .iter()
            .for_each(|record| fingerprint.take_in(record));
        if fingerprint.hex() != head.fingerprint {
            return Err(self.damaged(&path));
        }
        self.records = records.len();
        self.records_bytes = head.records_bytes;
        self.fingerprint = fingerprint;
        Ok(records)
    }

    fn damaged(&self, path: &Path) -> Failure {
        self.not_resumable(&format!("{} is damaged", path.display()))
    }

    /// Failure of a run that can't be continued, for this reason.
    pub(in crate::cli) fn not_resumable(&self, reason: &str) -> Failure {
        let folder = self.folder.display();
        Failure::Input(format!(
            "the run can't be resumed: {reason}; to begin anew, remove {folder}"
        ))
    }
}

/// A frame for a file.
fn frame_at(path: &Path, raw: &[u8]) -> Result<Vec<u8>, FileError> {
    frame::sealed(raw).map_err(|error| failed("compress", path)(io::Error::other(error)))
}

/// Records of all frames; none if a frame is damaged.
fn unframed(mut bytes: &[u8]) -> Option<Vec<Record>> {
    let mut records = Vec::new();
    while !bytes.is_empty() {
        let (raw, rest) = frame::opened(bytes)?;
        let more: Vec<Record> = postcard::from_bytes(&raw).ok()?;
        records.extend(more);
        bytes = rest;
    }
    Some(records)
}
